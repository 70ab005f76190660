// Which sources and which compiler this program is made of. Only main.cpp includes this, so that a
// commit compiles one small file again.
#pragma once

namespace xr3 {

/// What `xr3 --version` prints after the version: ` (commit 0123abc, GNU 12.2.0)`. The file that
/// defines it is written by cmake/BuildInfo.cmake.
extern const char* const kBuildInfo;

}  // namespace xr3
