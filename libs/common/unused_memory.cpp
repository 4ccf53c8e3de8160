#include "common/unused_memory.h"

#include <link.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>

namespace nao {
namespace {

// Segments that cannot be written hold what their files hold.
int release_code(dl_phdr_info* object, size_t /*size*/, void* /*user*/) {
  const auto page = static_cast<ElfW(Addr)>(sysconf(_SC_PAGESIZE));
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_LOAD || (segment.p_flags & PF_W) != 0) continue;
    const ElfW(Addr) first = object->dlpi_addr + segment.p_vaddr;
    const ElfW(Addr) begin = first / page * page;
    // A refusal, as of the kernel's own object, costs memory only.
    (void)madvise(reinterpret_cast<void*>(begin), first + segment.p_memsz - begin, MADV_DONTNEED);
  }
  return 0;
}

}  // namespace

void release_unused_memory() {
  malloc_trim(0);
  dl_iterate_phdr(release_code, nullptr);
}

}  // namespace nao
