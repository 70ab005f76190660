// The pseudo-terminals of `xr3 serve --pty`: each is a serial line while a program has it open.
#pragma once

#include <boost/asio/posix/stream_descriptor.hpp>
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
  void accept_arrived() override;
  void line_ended(LineId line, LineCloseReason reason) override;

 private:
  struct Served {
    PtyPlace& place;
    std::optional<LineId> line;  ///< nullopt: no program is there
    bool has_failed = false;     ///< as reported
  };

  asio::awaitable<void> follow_news();
  void take_news();
  void open_line(Served& served);
  static void report(Served& served);

  asio::io_context& io_;
  LineSessions& lines_;
  asio::posix::stream_descriptor news_;  ///< of the watch
  asio::steady_timer attended_;          ///< never expires; cancelled to resume those that settle
  std::optional<PtyWatch> watch_;        ///< nullopt: no pseudo-terminals
  std::vector<Served> served_;
  bool is_closing_ = false;
};

}  // namespace xr3
