// One client of the monitor without its connection: messages in, requests to carry out, and a lane
// of messages out that is bounded by what the client has not taken yet. JSON lines over TCP, and
// later others, are thin shells around it. It knows no cell; whoever does gives the answers.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/monitor_lines.hpp"
#include "protocol/monitor_message.hpp"
#include "protocol/monitor_request.hpp"

namespace xr3::monitor {

class Client {
 public:
  static constexpr std::size_t kMostAnswers = 256;
  static constexpr std::size_t kMostAnswerBytes = 256 * 1024;

  /// `cells` are those that a request may name, the default first.
  explicit Client(std::vector<std::string> cells) : cells_(std::move(cells)) {}

  /// Takes one message. A request is to be carried out, and answered by send(), before the next one
  /// is taken; a message that is none has been answered by its error.
  std::optional<Request> take(std::string_view message);

  /// Puts a message at the end of the lane. After end() nothing is taken any more.
  void send(Message message);
  /// Puts the last message at the end of the lane.
  void end(Bye why);
  bool has_ended() const { return has_ended_; }

  /// No request may be taken until the client has taken some of its answers.
  bool is_full() const { return lane_.size() >= kMostAnswers || lane_bytes_ >= kMostAnswerBytes; }

  /// The message that is to go out next, or null.
  Message next_output();

 private:
  std::vector<std::string> cells_;
  std::deque<Message> lane_;
  std::size_t lane_bytes_ = 0;
  bool has_ended_ = false;
};

/// Goes through the lines up to the next request to carry out. Nothing where more bytes are needed,
/// the lane is full, or the lines have ended the client.
std::optional<Request> next_request(Lines& lines, Client& client);

}  // namespace xr3::monitor
