// The viewer's files as they are linked into the binary; none where it was built without the viewer.
#pragma once

#include <string_view>

namespace xr3 {

struct WebAsset {
  std::string_view type;  ///< as Content-Type tells it
  std::string_view bytes;
};

/// The file under a path such as `/assets/main.js`, or `/index.html`. No type where there is none.
WebAsset find_web_asset(std::string_view path);

}  // namespace xr3
