#include "cli/term/console.hpp"

#include <csignal>
#include <iostream>

#include "cli/term/terminal.hpp"
#include "protocol/text/printable.hpp"
#include "server/net/spawn.hpp"
#include "tools/term/line_decoder.hpp"

namespace xr3 {
namespace {

/// Executes a request.
struct Act {
  TermSession& session;
  TermConsole& console;

  void operator()(const term::SendBytes& data) const { session.send(data.bytes); }
  void operator()(const term::SendFile& file) const { session.send_file(file.path); }
  void operator()(const term::SendBreak&) const { session.send_break(); }
  void operator()(const term::ShowHelp&) const { console.say(std::string(term::help_text())); }
  void operator()(const term::ShowHint& hint) const { console.say(std::string(hint.text)); }
  void operator()(const term::Quit&) const { session.stop(ExitCode::kGood); }
};

}  // namespace

TermConsole::TermConsole(asio::io_context& context, const TermOptions& options)
    : context_(context),
      options_(options),
      signals_(context, SIGINT, SIGTERM, SIGHUP),
      keyboard_(context) {
  signals_.add(SIGCONT);
}

void TermConsole::start(TermSession& session, const std::string& greeting) {
  session_ = &session;
  say(greeting);
  if (options_.edits_lines) show_edited();
  spawn_loop(context_.get_executor(), "term", read_keys());
  spawn_loop(context_.get_executor(), "term", await_signals());
}

asio::awaitable<void> TermConsole::read_keys() {
  for (;;) {
    const std::string_view bytes = co_await keyboard_.read();
    if (bytes.empty()) break;
    for (const term::Keystroke& key : keys_.feed(bytes)) {
      if (options_.edits_lines) {
        edit(key);
      } else {
        type(key);
      }
    }
  }
  session_->stop(ExitCode::kGood);
}

asio::awaitable<void> TermConsole::await_signals() {
  for (;;) {
    const auto [cancelled, number] = co_await signals_.async_wait(kAwait);
    if (cancelled) break;
    if (number != SIGCONT) {
      session_->stop(ExitCode::kGood);
      break;
    }
    terminal_.enter();
    if (options_.edits_lines) show_edited();
  }
}

// Sends a key. The bytes in hexadecimal replace the echo.
void TermConsole::type(const term::Keystroke& key) {
  const term::Typist::TypingResult outcome = typist_.press(key);
  const bool is_data = !outcome.requests.empty() &&
                       std::holds_alternative<term::SendBytes>(outcome.requests.front());
  if (!is_data || options_.view != TermView::kHex) write(screen_.type(outcome.echo));
  for (const term::UserRequest& request : outcome.requests) act(request);
}

void TermConsole::edit(const term::Keystroke& key) {
  switch (editor_.press(key)) {
    case term::LineEditor::Result::kNothing: break;
    case term::LineEditor::Result::kLine:
      write(screen_.end_edit());
      act(term::request_of_line(editor_.line()));
      break;
    case term::LineEditor::Result::kQuit: write(screen_.end_edit()); return act(term::Quit{});
  }
  show_edited();
}

void TermConsole::act(const term::UserRequest& request) {
  std::visit(Act{*session_, *this}, request);
}

void TermConsole::note_sent(std::string_view bytes, const std::vector<std::string>& ignored) {
  if (options_.view == TermView::kHex) return print(term::hex_lines('>', bytes));
  if (options_.view == TermView::kRaw) return;
  for (const std::string& sentence : ignored) print("  ! " + sentence);
}

void TermConsole::note_received(std::string_view bytes, const std::vector<std::string>& replies) {
  switch (options_.view) {
    case TermView::kHex: return print(term::hex_lines('<', bytes));
    case TermView::kRaw: return options_.edits_lines ? print(bytes) : write(screen_.type(bytes));
    case TermView::kText: break;
  }
  for (const std::string& reply : replies) print("  " + reply);
}

void TermConsole::say(const std::string& sentence) { print(printable_lines(sentence)); }

void TermConsole::print(std::string_view lines) {
  write(screen_.print(lines));
  typist_.begin_line();
}

void TermConsole::show_edited() {
  write(screen_.edit(editor_, static_cast<std::size_t>(terminal_size().columns)));
}

void TermConsole::write(const std::string& text) {
  std::cout << text << std::flush;
  if (!std::cout && session_ != nullptr) session_->stop(ExitCode::kInternal);
}

}  // namespace xr3
