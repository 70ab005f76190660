// Bodies of HTTP responses. Copies of a body share its bytes, so a large one exists only once, for
// however many clients it waits to be sent.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace xr3::http {

class Body {
 public:
  Body() = default;
  Body(std::string text)  // NOLINT(google-explicit-constructor): a text is a body
      : text_(std::make_shared<const std::string>(std::move(text))), bytes_(*text_) {}
  /// `bytes` must exist until the end of the process.
  static Body of_static(std::string_view bytes) {
    Body body;
    body.bytes_ = bytes;
    return body;
  }

  std::string_view bytes() const { return bytes_; }

 private:
  std::shared_ptr<const std::string> text_;  ///< null for static bytes
  std::string_view bytes_;
};

/// The body of one resource, made once for each value of the key on which its bytes depend.
template <class Key>
class BodyCache {
 public:
  /// The body for this key; makes it if the last one was for another key.
  template <class Make>
  Body get(const Key& key, const Make& make) {
    if (key_ != key) keep(key, make());
    return body_;
  }
  /// nullptr if the last body was for another key. Valid until the next call.
  const Body* find(const Key& key) const { return key_ == key ? &body_ : nullptr; }
  void keep(const Key& key, Body body) {
    key_ = key;
    body_ = std::move(body);
  }

 private:
  std::optional<Key> key_;
  Body body_;
};

}  // namespace xr3::http
