// The pseudo-terminals of `xr3 serve --pty`: each is a serial line while a program has it open.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <vector>

#include "server/lines/sessions.hpp"
#include "server/net/asio.hpp"
#include "server/pty/pump.hpp"

namespace xr3 {

class PtyPort final : public LineSource {
 public:
  /// `lines` must outlive the port, and the event loop must not run after it.
  PtyPort(asio::io_context& io, LineSessions& lines);

  /// Makes a pseudo-terminal at each path, whose slave has these rights, and opens a line for each
  /// program that opens it. Throws FileError.
  void serve(const std::vector<std::string>& paths, ::mode_t rights);
  /// Opens no further line.
  void close();

  asio::awaitable<void> settle() override;
  void accept_arrived() override;
  void line_ended(LineId, LineCloseReason) override { ++progress_; }

 private:
  struct ServedTerminal {
    ServedTerminal(const std::string& path, ::mode_t rights, const std::function<void()>& notify)
        : pump(path, rights, notify) {}

    PtyPump pump;
    bool has_failed = false;  ///< as reported
  };

  void notice();
  void accept(PtyPump& pump);
  static void report(ServedTerminal& terminal);
  asio::awaitable<void> run_round();

  asio::io_context& io_;
  LineSessions& lines_;
  asio::steady_timer round_ended_;  ///< never expires; cancelled to resume those that settle
  std::uint64_t progress_ = 0;      ///< lines begun and ended, and reads
  bool is_closing_ = false;
  std::list<ServedTerminal> terminals_;
};

}  // namespace xr3
