#include "phone-gateway/server/http/gzip.h"

#include <zlib.h>

#include "common/error.h"

namespace nao::gateway {

std::string gzip(std::string_view bytes) {
  // zlib.h, deflateInit2: largest window, 15, plus 16 for a gzip header; default memory level.
  constexpr int kGzipWindowBits = 15 + 16;
  constexpr int kMemoryLevel = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzipWindowBits, kMemoryLevel,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw Error("cannot compress: deflateInit2 failed");
  }
  // Upper bound of the compressed size: one call of deflate() suffices.
  std::string compressed(deflateBound(&stream, bytes.size()), '\0');
  // zlib does not change its input, but declares it without const.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(compressed.data());
  stream.avail_out = static_cast<uInt>(compressed.size());
  const int status = deflate(&stream, Z_FINISH);
  compressed.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw Error("cannot compress: deflate failed");
  return compressed;
}

}  // namespace nao::gateway
