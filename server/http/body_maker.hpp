// Makes the bodies of one resource in the worker's thread, once for all requests that can share
// one.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "server/http/body.hpp"
#include "server/net/asio.hpp"
#include "server/net/exclusive.hpp"
#include "server/net/worker.hpp"

namespace xr3::http {

template <class Key>
class BodyMaker {
 public:
  /// The key on which the bytes depend now, and the function that makes them. The function must not
  /// access anything that changes.
  struct Recipe {
    Key key;
    std::function<std::string()> make;
  };
  using Now = std::function<Recipe()>;

  BodyMaker(asio::io_context& io, Worker& worker) : worker_(worker), making_(io) {}

  /// The body as of a moment after this call. If many wait, they share the body that is begun next.
  /// Throws what the recipe throws.
  asio::awaitable<Body> get(Now now) {
    const std::uint64_t next = begun_ + 1;
    co_await making_.until_free();
    if (has_body_from(next)) co_return body_;
    Recipe recipe = now();
    if (key_ == recipe.key) co_return body_;
    co_return co_await make(std::move(recipe));
  }

 private:
  bool has_body_from(std::uint64_t begun) const { return key_ && body_begun_ >= begun; }

  asio::awaitable<Body> make(Recipe recipe) {
    const Exclusive::Hold hold(making_);
    const std::uint64_t begun = ++begun_;
    std::string text = co_await worker_.run(std::move(recipe.make));
    body_ = Body(std::move(text));
    key_ = std::move(recipe.key);
    body_begun_ = begun;
    co_return body_;
  }

  Worker& worker_;
  Exclusive making_;
  std::uint64_t begun_ = 0;       ///< how many bodies were begun
  std::uint64_t body_begun_ = 0;  ///< the number of `body_` among them
  std::optional<Key> key_;        ///< of `body_`
  Body body_;
};

}  // namespace xr3::http
