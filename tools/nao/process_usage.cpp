#include "tools/nao/process_usage.h"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace nao {

std::optional<ProcessUsage> read_process_usage(int process_id) {
  std::ifstream file("/proc/" + std::to_string(process_id) + "/stat");
  const std::string line((std::istreambuf_iterator<char>(file)), {});
  // Source: proc(5). Field 2 is the program's name in parentheses and may contain spaces. The rest
  // begins with field 3; utime is field 14, stime 15, rss 24.
  const size_t name_end = line.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(line.substr(name_end + 1));
  std::string field;
  double ticks = 0;
  ProcessUsage usage;
  for (int number = 3; number <= 24 && fields >> field; ++number) {
    if (number == 14 || number == 15) ticks += std::stod(field);
    if (number == 24) {
      usage.memory_bytes = std::stod(field) * static_cast<double>(sysconf(_SC_PAGESIZE));
    }
  }
  usage.cpu_seconds = ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
  return usage;
}

}  // namespace nao
