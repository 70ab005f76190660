// Compression of the chunks of an MCAP file.
#pragma once

#include "protocol/mcap/writer.hpp"

namespace xr3 {

/// Zstandard, one of the two compressions that every reader of MCAP has. Throws
/// std::runtime_error.
mcap::McapCompression zstd_compression();

}  // namespace xr3
