#include "server/http/pictures.hpp"

#include <cassert>
#include <string>
#include <utility>

#include "server/files/png.hpp"
#include "tools/drawing/pbm.hpp"

namespace xr3::http {

Body Pictures::bitmap(const ImagePtr& image) {
  assert(image);
  if (bitmap_.image != image) bitmap_ = {image, Body(to_pbm(*image))};
  return bitmap_.body;
}

asio::awaitable<Body> Pictures::png(ImagePtr image) {
  assert(image);
  co_await compressing_.until_free();
  if (png_.image != image) {
    const Exclusive::Hold hold(compressing_);
    auto work = [image] { return to_png(*image); };  // g++ 12 destroys an unnamed one twice
    std::string bytes = co_await worker_.run(std::move(work));
    png_ = {std::move(image), Body(std::move(bytes))};
  }
  co_return png_.body;
}

}  // namespace xr3::http
