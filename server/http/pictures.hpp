// The camera's pictures of one cell as bodies of HTTP responses, each made again only when the
// picture has changed: however many clients it waits to be sent to, it exists once.
#pragma once

#include "core/image.hpp"
#include "server/http/body.hpp"
#include "server/net/asio.hpp"
#include "server/net/exclusive.hpp"
#include "server/net/worker.hpp"

namespace xr3::http {

class Pictures {
 public:
  /// The references must outlive it.
  Pictures(asio::io_context& io, Worker& worker) : worker_(worker), compressing_(io) {}

  /// Precondition: `image` is not null.
  Body bitmap(const ImagePtr& image);
  /// Compresses in the worker, one picture at a time. Precondition: `image` is not null.
  asio::awaitable<Body> png(ImagePtr image);

 private:
  struct Encoded {
    ImagePtr image;
    Body body;
  };

  Worker& worker_;
  Exclusive compressing_;
  Encoded bitmap_;
  Encoded png_;
};

}  // namespace xr3::http
