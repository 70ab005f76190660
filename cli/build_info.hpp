// The sources and the compiler of this program. Only main.cpp includes this, so that a commit
// compiles one small file again.
#pragma once

namespace xr3 {

/// The text of `xr3 --version` after the version: ` (commit 0123abc, GNU 12.2.0)`. The file that
/// defines it is written by cmake/BuildInfo.cmake.
extern const char* const kBuildInfo;

}  // namespace xr3
