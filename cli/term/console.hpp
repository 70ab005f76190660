// `xr3 term` for a user at a terminal: keys go to the session, its reports go to the screen.
#pragma once

#include <boost/asio/signal_set.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/term.hpp"
#include "cli/term/raw_terminal.hpp"
#include "cli/term/session.hpp"
#include "server/net/standard_input.hpp"
#include "tools/term/screen.hpp"
#include "tools/term/typist.hpp"

namespace xr3 {

class TermConsole : public TermListener {
 public:
  /// Switches the terminal to key input until the destruction. The context and the options must
  /// outlive it.
  TermConsole(asio::io_context& context, const TermOptions& options);

  /// Prints a greeting and starts to read keys. The session must outlive the context's run.
  void start(TermSession& session, const std::string& greeting);

  void note_sent(std::string_view bytes, const std::vector<std::string>& ignored) override;
  void note_received(std::string_view bytes, const std::vector<std::string>& replies) override;
  void say(const std::string& sentence) override;

 private:
  asio::awaitable<void> read_keys();
  asio::awaitable<void> await_signals();
  void type(const term::Keystroke& key);
  void edit(const term::Keystroke& key);
  void act(const term::UserRequest& request);
  void print(std::string_view lines);
  void write(const std::string& text);
  void show_edited();

  asio::io_context& context_;
  const TermOptions& options_;
  TermSession* session_ = nullptr;
  asio::signal_set signals_;
  StandardInput keyboard_;
  RawTerminal terminal_;
  term::KeyReader keys_;
  term::Typist typist_;
  term::LineEditor editor_;
  term::TermScreen screen_;
};

}  // namespace xr3
