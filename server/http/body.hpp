// Bodies of HTTP responses. Copies of a body share its bytes, so a large one exists only once, for
// however many clients it waits to be sent.
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace xr3::http {

class Body {
 public:
  Body() = default;
  Body(std::string text)  // NOLINT(google-explicit-constructor): a text is a body
      : Body(std::make_shared<const std::string>(std::move(text))) {}
  /// Shares a text. Precondition: it is not null.
  explicit Body(std::shared_ptr<const std::string> text) : text_(std::move(text)) {
    assert(text_);
    bytes_ = *text_;
  }
  /// `bytes` must exist until the end of the process.
  static Body of_static(std::string_view bytes) {
    Body body;
    body.bytes_ = bytes;
    return body;
  }

  std::string_view bytes() const { return bytes_; }

  /// The number of bytes divided by the number of bodies that share them; 0 for static bytes.
  std::size_t share_bytes() const {
    return text_ ? bytes_.size() / static_cast<std::size_t>(text_.use_count()) : 0;
  }

 private:
  std::shared_ptr<const std::string> text_;  ///< null for static bytes
  std::string_view bytes_;
};

}  // namespace xr3::http
