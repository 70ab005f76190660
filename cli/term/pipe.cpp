#include "cli/term/pipe.hpp"

#include <iostream>

#include "protocol/text/printable.hpp"
#include "server/net/spawn.hpp"
#include "server/print.hpp"
#include "tools/term/line_decoder.hpp"

namespace xr3 {

void TermPipe::start(TermSession& session) {
  session_ = &session;
  spawn_loop(context_.get_executor(), "term", copy_input());
}

asio::awaitable<void> TermPipe::copy_input() {
  for (;;) {
    const std::string_view bytes = co_await input_.read();
    if (bytes.empty()) break;
    session_->send(bytes);
    co_await session_->when_sent();
  }
  session_->finish();
}

void TermPipe::note_sent(std::string_view bytes, const std::vector<std::string>& ignored) {
  if (view_ == TermView::kHex) return write(term::hex_lines('>', bytes));
  if (view_ == TermView::kRaw) return;
  for (const std::string& sentence : ignored) say(sentence);
}

void TermPipe::note_received(std::string_view bytes, const std::vector<std::string>& replies) {
  if (view_ == TermView::kHex) return write(term::hex_lines('<', bytes));
  if (view_ == TermView::kRaw) return write(bytes);
  for (const std::string& reply : replies) write(reply + "\n");
}

void TermPipe::say(const std::string& sentence) {
  print_error("xr3: " + printable_line(sentence) + "\n");
}

void TermPipe::write(std::string_view text) {
  std::cout << text << std::flush;
  if (!std::cout) session_->stop(ExitCode::kGood);  // main reports that the output is lost
}

}  // namespace xr3
