#include "server/pty/port.hpp"

#include <spdlog/spdlog.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/system/system_error.hpp>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <memory>

#include "cell/failure.hpp"
#include "server/files/data_files.hpp"
#include "server/net/spawn.hpp"
#include "server/pty/stream.hpp"

namespace xr3 {
namespace {

constexpr const char* kPtyName = "the pseudo-terminals";

[[noreturn]] void fail_to_watch() {
  throw FileError(std::string("a pseudo-terminal cannot be watched: ") + std::strerror(errno));
}

}  // namespace

void PtyPort::serve(const std::vector<std::string>& paths, ::mode_t rights) {
  assert(places_.empty());
  if (paths.empty()) return;
  const int opens = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  if (opens < 0) fail_to_watch();
  opens_.assign(opens);
  rights_ = rights;
  for (const std::string& path : paths) {
    watch(places_.emplace_back(path, rights).terminal);
  }
  lines_.add(*this);
  spawn_loop(io_.get_executor(), kPtyName, run());
}

void PtyPort::watch(const PseudoTerminal& terminal) {
  if (::inotify_add_watch(opens_.native_handle(), terminal.slave().c_str(), IN_OPEN) < 0)
    fail_to_watch();
}

void PtyPort::close() {
  is_closing_ = true;
  ErrorCode ignored;
  opens_.close(ignored);
}

// An event says only that something was opened, perhaps by this process: accept_arrived() looks.
asio::awaitable<void> PtyPort::run() {
  std::array<char, 4096> events{};
  while (opens_.is_open()) {
    const auto [error, count] = co_await opens_.async_read_some(asio::buffer(events), kAwait);
    if (is_closing_) co_return;
    if (error) throw boost::system::system_error(error, "inotify");
    vital(kPtyName, [this] { accept_arrived(); });
  }
}

void PtyPort::accept_arrived() {
  if (is_closing_) return;
  for (Place& place : places_) {
    if (place.line || !place.terminal.has_client()) continue;
    place.line = lines_.open(*this, std::make_unique<PtyStream>(place.terminal),
                             LineOpened{place.link.path(), LineKind::kPty});
  }
}

void PtyPort::line_ended(LineId line, LineCloseReason reason) {
  const auto place = std::ranges::find(places_, std::optional(line), &Place::line);
  if (is_closing_ || place == places_.end()) return;
  place->line.reset();
  make_ready(*place, reason);
}

// A program whose line the server has ended sees a hangup, as if the plug of an adapter were
// pulled.
void PtyPort::make_ready(Place& place, LineCloseReason reason) {
  try {
    reason == LineCloseReason::kClientClosed ? place.terminal.prepare() : renew(place);
    accept_arrived();  // the next program may have opened the slave meanwhile
  } catch (const FileError& error) {
    spdlog::error("{}: {}; nothing is served there any more", place.link.path(), error.what());
  }
}

void PtyPort::renew(Place& place) {
  PseudoTerminal fresh(rights_);
  place.link.point_to(fresh.slave());
  place.terminal = std::move(fresh);
  watch(place.terminal);
}

}  // namespace xr3
