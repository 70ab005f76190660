// The pseudo-terminals of `xr3 serve --pty`: each is a serial line while a program has it open.
#pragma once

#include <boost/asio/posix/stream_descriptor.hpp>
#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "server/lines/sessions.hpp"
#include "server/net/asio.hpp"
#include "server/pty/watch.hpp"

namespace xr3 {

class PtyPort final : public LineSource {
 public:
  /// `lines` must outlive the port.
  PtyPort(asio::io_context& io, LineSessions& lines);

  /// Makes a pseudo-terminal at each path, whose slave has these rights, and opens lines from now
  /// on. Throws FileError.
  void serve(const std::vector<std::string>& paths, ::mode_t rights);
  /// Opens no further line.
  void close();

  asio::awaitable<void> settle() override;
  std::uint64_t progress() const override { return progress_; }
  void accept_arrived() override;
  void line_acted(LineId) override { ++progress_; }
  void line_ended(LineId line, LineCloseReason reason) override;

 private:
  struct Terminal {
    Terminal(asio::io_context& io, const std::string& path, ::mode_t rights);

    PtyWatch watch;
    asio::posix::stream_descriptor news;  ///< of the watch
    std::optional<LineId> line;           ///< nullopt: no program is there
    bool has_failed = false;              ///< as reported
  };

  asio::awaitable<void> follow_news(Terminal& terminal);
  void take_news(Terminal& terminal);
  void accept(Terminal& terminal);
  static void report(Terminal& terminal);

  asio::io_context& io_;
  LineSessions& lines_;
  asio::steady_timer round_ended_;  ///< never expires; cancelled to resume those that settle
  std::list<Terminal> terminals_;
  std::uint64_t progress_ = 0;  ///< lines begun and ended, and actions of lines
  bool is_closing_ = false;
};

}  // namespace xr3
