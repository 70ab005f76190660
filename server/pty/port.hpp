// The pseudo-terminals of `xr3 serve --pty`: each is a serial line while a program has it open.
#pragma once

#include <boost/asio/posix/stream_descriptor.hpp>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "server/lines/sessions.hpp"
#include "server/net/asio.hpp"
#include "server/pty/link.hpp"
#include "server/pty/pseudo_terminal.hpp"

namespace xr3 {

class PtyPort final : public LineSource {
 public:
  /// `lines` must outlive the port.
  PtyPort(asio::io_context& io, LineSessions& lines) : io_(io), lines_(lines), opens_(io) {}

  /// Makes a pseudo-terminal at each path, whose slave has these rights, and opens lines from now
  /// on. Throws FileError.
  void serve(const std::vector<std::string>& paths, ::mode_t rights);
  /// Opens no further line.
  void close();

  void accept_arrived() override;
  void line_ended(LineId line, LineCloseReason reason) override;

 private:
  struct Place {
    Place(const std::string& path, ::mode_t rights)
        : terminal(rights), link(path, terminal.slave()) {}

    PseudoTerminal terminal;
    PtyLink link;
    std::optional<LineId> line;  ///< nullopt: no program has it open
  };

  void watch(const PseudoTerminal& terminal);
  asio::awaitable<void> run();
  void make_ready(Place& place, LineCloseReason reason);
  void renew(Place& place);

  asio::io_context& io_;
  LineSessions& lines_;
  asio::posix::stream_descriptor opens_;  ///< inotify: a program has opened a slave
  ::mode_t rights_ = 0;
  std::list<Place> places_;
  bool is_closing_ = false;
};

}  // namespace xr3
