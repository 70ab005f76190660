// Checks the messages that a monitor client receives: each is JSON, `hello` comes first, the
// replies come in the order of the requests with their ids, and no message of a ring is missing
// without `lag`.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace xr3::seeds {

class Messages {
 public:
  /// All requests have ids that begin with `prefix`.
  explicit Messages(std::string prefix) : prefix_(std::move(prefix)) {}

  /// A request is on its way. `reply` is the `op` of the message that answers it.
  void expect(const std::string& id, const std::string& reply);
  /// The `hex` of the value of this result must be this.
  void expect_hex(const std::string& id, std::string hex) { hex_[id] = std::move(hex); }

  /// Checks a message; returns what is wrong with it, or nothing.
  std::string feed(std::string_view message);

  bool has_hello() const { return has_hello_; }
  /// The reason in `bye`; empty before.
  const std::string& bye() const { return bye_; }
  std::size_t unanswered() const { return expected_.size(); }

 private:
  struct Expected {
    std::string id;
    std::string reply;
  };

  class Reader;
  bool can_skip(std::string_view message);

  std::string prefix_;
  std::deque<Expected> expected_;
  std::map<std::string, std::string> hex_;
  std::map<std::string, std::int64_t> next_seq_;  ///< of a subscribed ring
  bool has_hello_ = false;
  std::size_t frames_ = 0;
  std::string bye_;
};

}  // namespace xr3::seeds
