// The client's side of the monitor port for somebody who looks on: which requests to send, and what
// is known after each message. Messages in, values out; it knows no socket and no screen, and takes
// nothing for granted about what a server sends: members that are missing keep their defaults.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/json_source.hpp"
#include "protocol/watch_known.hpp"

namespace xr3::watch {

/// Most notes that are kept.
inline constexpr std::size_t kMostNotes = 256;

/// For how long somebody wants to look.
enum class Interest : std::uint8_t { kOnce, kOn };

/// What is asked for: which cell, and with which token. Both may be empty.
struct Wish {
  std::string cell;
  std::string token;
  Interest interest = Interest::kOn;
};

/// What a key asks of the cell.
enum class Action : std::uint8_t { kPauseOrResume, kStep, kStepSecond, kHome };

class WatchModel {
 public:
  explicit WatchModel(Wish wish) : wish_(std::move(wish)) {}

  /// What opens a connection: a program that sends first is greeted at once. It is the beginning of
  /// a line that goes on with the first answer of `take`.
  std::string opening() const;

  /// The line that asks whether the server is still there, with its line feed.
  std::string ping() const { return "{\"op\":\"ping\"}\n"; }

  /// Takes one message, any bytes; returns the lines to send now, each with its line feed.
  std::vector<std::string> take(std::string_view line);

  /// The line that asks for this, with its line feed; nothing, and a word in `known().said`, where
  /// calls are not ours.
  std::optional<std::string> ask(Action action);

  const Known& known() const { return known_; }
  /// Whoever wants to look once knows all that there is to know.
  bool is_complete() const { return is_complete_; }
  /// The server said that this is its last message.
  bool has_parted() const { return has_parted_; }

 private:
  std::vector<std::string> take_hello(const Json& message);
  std::vector<std::string> first_requests(const Json& channels) const;
  void take_state(const Json& message);
  void take_model(const Json& message);
  void take_event(const Json& message);
  void take_result(const Json& message);
  std::string request(Json members) const;
  bool is_of_our_cell(const Json& message) const;

  Wish wish_;
  Known known_;
  bool is_complete_ = false;
  bool has_parted_ = false;
};

}  // namespace xr3::watch
