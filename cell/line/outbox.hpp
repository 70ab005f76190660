// The bytes that a line has for its transport to send, with their offsets in all of its output.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace xr3 {

class Outbox {
 public:
  /// Valid until the outbox changes.
  std::string_view bytes() const { return {text_.data() + sent_, text_.size() - sent_}; }
  /// Offsets of the first byte and of the one after the last.
  std::uint64_t begin() const { return begin_; }
  std::uint64_t end() const { return begin_ + bytes().size(); }

  /// New bytes may be appended to this text, and to nothing else of it.
  std::string& end_bytes() { return text_; }

  /// Removes the first bytes. A large image is sent in many pieces: to keep the cost linear, the
  /// unsent bytes move to the front only when they are no more than the sent ones. Precondition:
  /// count <= bytes().size().
  void sent(std::size_t count) {
    assert(count <= bytes().size());
    sent_ += count;
    begin_ += count;
    if (sent_ < text_.size() - sent_) return;
    text_.erase(0, sent_);
    sent_ = 0;
  }

  bool operator==(const Outbox&) const = default;

 private:
  std::string text_;
  std::size_t sent_ = 0;     ///< bytes at the start of the text that are already sent
  std::uint64_t begin_ = 0;  ///< bytes sent
};

}  // namespace xr3
