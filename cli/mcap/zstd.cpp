#include "cli/mcap/zstd.hpp"

#include <zstd.h>

#include <stdexcept>
#include <string>

namespace xr3 {
namespace {

std::string zstd_frame(std::string_view bytes) {
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), ZSTD_CLEVEL_DEFAULT);
  if (ZSTD_isError(size) != 0)
    throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  frame.resize(size);
  return frame;
}

}  // namespace

mcap::McapCompression zstd_compression() { return {"zstd", zstd_frame}; }

}  // namespace xr3
