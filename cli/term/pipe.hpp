// `xr3 term` for a script: bytes of standard input go to the line unchanged, replies go to standard
// output, sentences to standard error. A signal ends the process as usual: no terminal is to be
// restored, and an exit code 0 would say that everything was answered.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/options/term.hpp"
#include "cli/term/session.hpp"
#include "server/net/standard_input.hpp"

namespace xr3 {

class TermPipe : public TermListener {
 public:
  TermPipe(asio::io_context& context, TermView view)
      : context_(context), view_(view), input_(context) {}

  /// Starts to read standard input; its end finishes the session, which must outlive the context's
  /// run.
  void start(TermSession& session);

  void note_sent(std::string_view bytes, const std::vector<std::string>& ignored) override;
  void note_received(std::string_view bytes, const std::vector<std::string>& replies) override;
  void say(const std::string& sentence) override;

 private:
  asio::awaitable<void> copy_input();
  void write(std::string_view text);

  asio::io_context& context_;
  TermView view_;
  TermSession* session_ = nullptr;
  StandardInput input_;
};

}  // namespace xr3
