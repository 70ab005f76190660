#include "server/resources/web_assets.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "server/resources/web_assets_table.hpp"

namespace xr3 {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 18> kTypes{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".gif", "image/gif"},
    {".ico", "image/x-icon"},
    {".webp", "image/webp"},
    {".woff2", "font/woff2"},
    {".wasm", "application/wasm"},
    {".txt", "text/plain; charset=utf-8"},
    {".py", "text/plain; charset=utf-8"},
    {".zip", "application/zip"},
    {".xml", "application/xml"},
    {".glb", "model/gltf-binary"},
}};

}  // namespace

std::string_view web_type(std::string_view path) {
  const auto* known = std::find_if(kTypes.begin(), kTypes.end(),
                                   [path](const auto& type) { return path.ends_with(type.first); });
  return known == kTypes.end() ? "application/octet-stream" : known->second;
}

WebAsset find_web_asset(std::string_view path) {
  for (const EmbeddedFile& file : embedded_files()) {
    const auto size = static_cast<std::size_t>(file.end - file.begin);
    if (path == file.path) return {web_type(path), {file.begin, size}};
  }
  return {};
}

}  // namespace xr3
