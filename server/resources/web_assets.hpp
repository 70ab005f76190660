// The viewer's files embedded in the binary; none if it was built without the viewer.
#pragma once

#include <string_view>

namespace xr3 {

struct WebAsset {
  std::string_view type;  ///< the Content-Type
  std::string_view bytes;
};

/// The Content-Type of a file, by the end of its name.
std::string_view web_type(std::string_view path);

/// The file with a path such as `/assets/main.js`. `type` is empty if it does not exist.
WebAsset find_web_asset(std::string_view path);

}  // namespace xr3
