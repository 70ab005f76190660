// Replies that a line keeps back because its client has suspended them. Bounded: the line takes no
// more data when the hold is full, and only the first replies keep their meaning for the records of
// the line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/explain/wire_record.hpp"
#include "protocol/line/state_writer.hpp"

namespace xr3 {

/// The bytes of replies, and items that cover them: `from` and `to` are offsets in `bytes`.
struct HeldReplies {
  std::string bytes;
  std::vector<wire::Item> items;
  bool operator==(const HeldReplies&) const = default;
};

class ReplyHold {
 public:
  /// With this many bytes the hold is full. The last reply may exceed it, as an image does.
  static constexpr std::size_t kFull = 64 * 1024;
  /// Replies with an item of their own. One item covers all further ones.
  static constexpr std::size_t kMaxItems = 256;

  void begin() { is_on_ = true; }
  bool is_on() const { return is_on_; }
  bool is_full() const { return held_.bytes.size() >= kFull; }
  std::size_t size() const { return held_.bytes.size(); }

  /// Adds the bytes of a reply with its meaning. Precondition: is_on().
  void add(std::string_view reply, const wire::Meaning& meaning);
  /// Forgets the replies; the hold stays on.
  void discard() { held_ = {}; }
  /// Returns the replies, which the caller must send, and ends the hold.
  HeldReplies end();

  void write_state(StateWriter& out) const { out.add(is_on_, held_.bytes); }

  bool operator==(const ReplyHold&) const = default;

 private:
  bool is_on_ = false;
  HeldReplies held_;
};

}  // namespace xr3
