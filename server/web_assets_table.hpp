// The table that the build makes of the viewer's files: see web_assets.cmake. Only web_assets.cpp
// includes this.
#pragma once

#include <span>

namespace xr3 {

struct EmbeddedFile {
  const char* path;  ///< begins with a slash
  const char* begin;
  const char* end;
};

std::span<const EmbeddedFile> embedded_files();

}  // namespace xr3
