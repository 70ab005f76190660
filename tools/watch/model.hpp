// The client side of the monitor protocol for `xr3 watch`: the requests to send, and the data after
// each message. Messages in, values out; independent of sockets and the screen. Messages are not
// trusted: missing members keep their defaults.
//
// The flow through the folder: the connection (cli/commands/watch_connection.hpp) sends opening()
// and passes each line of the server to handle(), which returns the lines to send next: after
// `hello` the access token and the subscriptions to state, image, display, model and event.
// Messages are read by read.hpp into the values of watched_cell.hpp. After each read the caller
// paints watch_screen() (screen.hpp), which divides the terminal among the panels: joints.cpp,
// lines.cpp, and those of panels.cpp. A key becomes an Action, a function of command mode
// (command_mode.hpp) or a character of the token (token_prompt.hpp), and ask() makes the request
// for it. ask_time() and ask_lines() poll values that the server does not publish. With --once the
// model requests everything once and is_complete() ends it. top_view.hpp draws a workcell from
// above, also for the workcell editor and reports.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/json/source.hpp"
#include "tools/watch/command_mode.hpp"
#include "tools/watch/watched_cell.hpp"

namespace xr3::watch {

/// Maximum number of notes kept.
inline constexpr std::size_t kMaxNotes = 256;

/// Whether to fetch the data once or to subscribe to it.
enum class Interest : std::uint8_t { kOnce, kOn };

/// The user's choice of cell, token and interest. `cell` and `token` may be empty.
struct Wish {
  std::string cell;
  std::string token;
  Interest interest = Interest::kOn;
  bool wants_lines = false;  ///< Interest::kOnce: the serial lines, too
};

/// An action triggered by a key.
enum class Action : std::uint8_t { kPauseOrResume, kStep, kStepSecond };

class WatchModel {
 public:
  explicit WatchModel(Wish wish) : wish_(std::move(wish)) {}

  /// The first bytes to send on a connection: the server sends `hello` at once to a client that
  /// sends first. They are the beginning of a line, which the first result of `take` continues.
  std::string opening();

  /// A ping request, with its line feed.
  std::string ping() const { return "{\"op\":\"ping\"}\n"; }

  /// Handles one message, which may be any bytes. Returns the lines to send, each with its line
  /// feed.
  std::vector<std::string> handle(std::string_view line);

  /// The request for this action, with its line feed. nullopt without permission for calls;
  /// `known().last_message` then has a message.
  std::optional<std::string> ask(Action action);
  /// The request for a function of command mode, under the conditions of an action.
  std::optional<std::string> ask(const FunctionCall& call);

  /// The request for the time, which advances while nothing is published. nullopt before the first
  /// state.
  std::optional<std::string> ask_time() const;
  /// The request for the serial lines. nullopt without permission for calls, or while the last one
  /// is not answered.
  std::optional<std::string> ask_lines();
  /// The request for access with this token, which is kept for later connections unless the server
  /// refuses it.
  std::string unlock(std::string token);

  const Known& known() const { return known_; }
  /// Whether, for Interest::kOnce, all data has been received.
  bool is_complete() const { return is_complete_; }
  /// Whether the server has sent `bye`.
  bool has_left() const { return has_left_; }

 private:
  std::vector<std::string> handle_hello(const Json& message);
  std::vector<std::string> first_requests(const Json& channels);
  void handle_state(const Json& message);
  void handle_time(const Json& message);
  void handle_model(const Json& message);
  void handle_event(const Json& message);
  void handle_result(const Json& message);
  void handle_refusal(const Json& message);
  bool may_call();
  std::string how_to_unlock() const;
  std::string auth() const;
  std::string call(const char* id, const char* fn, Json args) const;
  std::string request(Json members) const;
  bool is_of_our_cell(const Json& message) const;

  Wish wish_;
  Known known_;
  bool is_opened_ = false;       ///< the request that opening() begins is complete
  bool has_sent_token_ = false;  ///< on this connection
  bool is_asking_lines_ = false;
  bool is_complete_ = false;
  bool has_left_ = false;
};

}  // namespace xr3::watch
