// The exchange of `xr3 term` with its peer: queued data is sent as fast as the peer reads and
// replies, while replies are always read, so that neither side can block the other. One thread.
//
// The flow through the folder: run_command() (term.cpp) opens the peer (peer.hpp): a TCP
// connection, perhaps with RFC 2217 (tcp_peer.hpp), or a device (device_peer.hpp). At a terminal
// TermConsole (console.hpp) switches it to raw keys (raw_terminal.hpp), reads them
// (server/net/standard_input.hpp), and asks tools/term for their meaning; for a script TermPipe
// (pipe.hpp) passes standard input on unchanged. Both are the listener of a TermSession and queue
// bytes, files and breaks in it. One coroutine of the session writes: it takes the next chunk,
// unless too many inquiries are unanswered or the peer has suspended sending. The other reads, and
// passes the bytes through the LineDecoder (tools/term/line_decoder.hpp) to the listener, with
// decoded replies. A timer completes replies of unknown length and reports missing ones. The
// session ends when the input has ended and is answered, or when the peer is lost; then it stops
// the context with the exit code.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/term/peer.hpp"
#include "server/base/exit_code.hpp"
#include "tools/term/line_decoder.hpp"

namespace xr3 {

/// Receives the reports of a session.
class TermListener {
 public:
  TermListener() = default;
  TermListener(const TermListener&) = delete;
  TermListener& operator=(const TermListener&) = delete;
  virtual ~TermListener() = default;

  /// Reports bytes that are sent now, and the reasons why the controller ignores some of them.
  virtual void note_sent(std::string_view bytes, const std::vector<std::string>& ignored) = 0;
  /// Reports received bytes, and the replies that they complete, decoded.
  virtual void note_received(std::string_view bytes, const std::vector<std::string>& replies) = 0;
  /// Reports a sentence for the user.
  virtual void say(const std::string& sentence) = 0;
};

class TermSession {
 public:
  struct Limits {
    std::chrono::milliseconds timeout;  ///< for a reply
    bool gives_up_sending = false;      ///< end if the peer accepts no byte for `timeout`
  };

  /// The context, the peer and the listener must outlive it.
  TermSession(asio::io_context& context, TermPeer& peer, std::string peer_name,
              const ReplyContext& robot, Limits limits, TermListener& listener);

  /// Starts reading and writing; the context must run. Both end with the context.
  void start();

  void send(std::string_view bytes);
  /// Sends a file behind everything that is already queued. Reports the end, or the reason why it
  /// failed.
  void send_file(const std::string& path);
  /// Sends a break when the queued data has been sent.
  void send_break();
  /// Resumes when everything that was queued has been sent.
  asio::awaitable<void> when_sent();
  /// Ends when everything has been sent and answered.
  void finish();
  /// Stops the context; exit_code() then has the code.
  void stop(ExitCode code);

  ExitCode exit_code() const { return exit_code_; }

 private:
  /// Something to send: bytes, a file, or a break.
  struct Source {
    std::string bytes;
    std::optional<std::ifstream> file;
    std::string path;
    std::uint64_t sent = 0;
    bool is_break = false;
  };

  asio::awaitable<void> read_loop();
  asio::awaitable<void> write_loop();
  asio::awaitable<bool> write_next();
  std::string next_chunk();
  std::string next_of_file(Source& source);
  bool may_send() const;
  void end_input();
  void lose_peer();
  void warn_of_monitor_port(std::string_view first_bytes);
  void restart_timeout();
  void note_timeout();
  void restart_burst();
  void report_sent_file(const Source& source);
  void wake();

  asio::io_context& context_;
  TermPeer& peer_;
  std::string peer_name_;
  Limits limits_;
  TermListener& listener_;
  term::LineDecoder decoder_;
  std::deque<Source> sources_;
  asio::steady_timer woken_;  ///< for the write loop: cancelled when there is something to do
  asio::steady_timer sent_;   ///< for when_sent(): cancelled when sources_ is empty
  asio::steady_timer timeout_;
  asio::steady_timer burst_;
  asio::steady_timer last_words_;  ///< after finish(): limits the wait for the peer's last bytes
  bool is_wake_pending_ = false;
  bool has_received_ = false;
  bool is_writing_ = false;
  bool is_finishing_ = false;
  bool is_input_ended_ = false;
  ExitCode exit_code_ = ExitCode::kGood;
};

}  // namespace xr3
