#include <sys/ioctl.h>
#include <unistd.h>

#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>

#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "cli/commands/watch_connection.hpp"
#include "cli/term/terminal.hpp"
#include "server/net/spawn.hpp"
#include "server/options/token.hpp"
#include "server/print.hpp"
#include "tools/watch/screen.hpp"
#include "tools/watch/token_prompt.hpp"

namespace xr3 {
namespace {

using watch::Action;
using watch::Link;
using watch::Page;

constexpr std::chrono::seconds kBeforeReconnect{1};
constexpr std::chrono::seconds kRefreshEvery{1};
constexpr std::chrono::seconds kOnceAtMost{15};

watch::Wish wish_of(const WatchOptions& options, watch::Interest interest) {
  TokenSource source = NoToken{};
  if (is_token_in_environment()) source = TokenInEnvironment{};
  if (!options.token_file.empty()) source = TokenFile{options.token_file};
  return {options.cell, read_token(source), interest, options.shows_lines};
}

Letters letters_of(const WatchOptions& options, Letters otherwise) {
  return options.is_ascii ? Letters::kAscii : otherwise;
}

/// The colours; none if NO_COLOR is set: https://no-color.org
Colors colors_of(const WatchOptions& options) {
  const char* wish = std::getenv("NO_COLOR");
  const bool is_unwanted = options.is_plain || (wish != nullptr && *wish != '\0');
  return is_unwanted ? Colors::kNo : Colors::kYes;
}

/// Runs until stopped: repaints after each message, and reconnects after each lost connection.
class Watcher {
 public:
  Watcher(asio::io_context& context, const WatchOptions& options)
      : model_(wish_of(options, watch::Interest::kOn)),
        connection_(context, options, model_),
        before_next_try_(context),
        refresh_(context),
        signals_(context, SIGINT, SIGTERM, SIGHUP),
        resizes_(context, SIGWINCH),
        keyboard_(context),
        terminal_(letters_of(options, letters_of_locale()), colors_of(options)) {
    link_.address = options.address.text;
    is_lines_open_ = options.shows_lines;
  }

  void start(asio::io_context& context) {
    spawn_loop(context.get_executor(), "watch", stay_connected());
    spawn_loop(context.get_executor(), "watch", await_resizes());
    signals_.async_wait([this](ErrorCode cancelled, int) {
      if (!cancelled) stop();
    });
    if (::isatty(STDIN_FILENO) == 0) return;
    keyboard_.assign(::dup(STDIN_FILENO));
    spawn_loop(context.get_executor(), "watch", await_keys());
  }

 private:
  asio::awaitable<void> stay_connected() {
    while (!is_stopping_) {
      show();
      link_.trouble = co_await connection_.run([this] { show_news(); });
      link_.phase = Link::Phase::kTrying;
      if (is_stopping_) break;
      show();
      before_next_try_.expires_after(kBeforeReconnect);
      co_await before_next_try_.async_wait(kAwait);
    }
  }

  void show_news() {
    const bool is_new = std::exchange(link_.phase, Link::Phase::kLive) != Link::Phase::kLive;
    if (is_new) refresh();
    show();
  }

  asio::awaitable<void> await_resizes() {
    while (!is_stopping_) {
      const auto [cancelled, number] = co_await resizes_.async_wait(kAwait);
      if (cancelled) break;
      terminal_.resize();
      show();
    }
  }

  asio::awaitable<void> await_keys() {
    while (!is_stopping_) {
      const auto [cancelled] =
          co_await keyboard_.async_wait(asio::posix::stream_descriptor::wait_read, kAwait);
      if (cancelled) break;
      int waiting = 0;
      const bool has_gone = ::ioctl(STDIN_FILENO, FIONREAD, &waiting) != 0 || waiting == 0;
      if (has_gone) stop();
      // NOLINTNEXTLINE(bugprone-unchecked-optional-access): the loop's condition has checked it
      while (const auto key = terminal_.key()) press(*key);
    }
  }

  void press(const watch::ModeKey& key) {
    const Page before = page();
    if (token_prompt_.is_open()) {
      if (auto token = token_prompt_.press(key)) connection_.send(model_.unlock(*std::move(token)));
    } else {
      press_in_page(key);
    }
    if (page() != before) ask_lines();
    show();
  }

  void press_in_page(const watch::ModeKey& key) {
    const watch::CommandMode::KeyResult outcome = command_mode_.press(key, model_.known().display);
    if (outcome.call) act(*outcome.call);
    if (!outcome.is_taken && !key.is_alt) press_letter(key.letter);
  }

  void press_letter(char letter) {
    constexpr char kEscape = '\x1B';
    static const std::map<char, Action> actions{
        {' ', Action::kPauseOrResume}, {'.', Action::kStep}, {'>', Action::kStepSecond}};
    if (letter == kEscape && page() == Page::kLines) return toggle_lines();
    if (letter == 'q' || letter == kEscape) return stop();
    if (letter == '?') is_help_open_ = !is_help_open_;
    if (letter == 'l') toggle_lines();
    if (letter == 't' && !model_.known().has_control) token_prompt_.open();
    if (const auto action = actions.find(letter); action != actions.end()) act(action->second);
  }

  void toggle_lines() {
    if (page() == Page::kLines || page() == Page::kCell) is_lines_open_ = !is_lines_open_;
  }

  /// Asks once a second for the values that the server does not publish: the time of a robot at
  /// rest, and the lines while their page is on the screen.
  void refresh() {
    if (is_stopping_ || link_.phase != Link::Phase::kLive) return;
    if (const auto request = model_.ask_time()) connection_.send(*request);
    ask_lines();
    run_after(refresh_, kRefreshEvery, [this] { refresh(); });
  }

  void ask_lines() {
    if (page() != Page::kLines) return;
    if (const auto request = model_.ask_lines()) connection_.send(*request);
  }

  void act(const auto& wanted) {
    if (link_.phase != Link::Phase::kLive) return;
    if (const auto request = model_.ask(wanted)) connection_.send(*request);
  }

  Page page() const {
    if (is_help_open_) return Page::kHelp;
    if (command_mode_.is_menu_open()) return Page::kMenu;
    return is_lines_open_ ? Page::kLines : Page::kCell;
  }

  void show() {
    if (is_stopping_) return;
    const TerminalSize size = terminal_size();
    const std::string prompt =
        token_prompt_.is_open() ? token_prompt_.text() : command_mode_.prompt();
    terminal_.show(
        watch::watch_screen(model_.known(), link_, page(), size.rows, size.columns, prompt));
  }

  /// Cancels everything pending, so that the event loop ends.
  void stop() {
    is_stopping_ = true;
    connection_.close();
    before_next_try_.cancel();
    refresh_.cancel();
    signals_.cancel();
    resizes_.cancel();
    keyboard_.close();
  }

  watch::WatchModel model_;
  WatchConnection connection_;
  asio::steady_timer before_next_try_;
  asio::steady_timer refresh_;
  // created before the terminal: ncurses does not replace existing signal handlers
  asio::signal_set signals_;
  asio::signal_set resizes_;
  asio::posix::stream_descriptor keyboard_;
  Terminal terminal_;
  Link link_;
  watch::CommandMode command_mode_;
  watch::TokenPrompt token_prompt_;
  bool is_help_open_ = false;
  bool is_lines_open_ = false;
  bool is_stopping_ = false;
};

ExitCode watch_on(const WatchOptions& options) {
  asio::io_context context;
  Watcher watcher(context, options);
  watcher.start(context);
  context.run();
  return ExitCode::kGood;
}

ExitCode watch_once(const WatchOptions& options) {
  asio::io_context context;
  watch::WatchModel model(wish_of(options, watch::Interest::kOnce));
  WatchConnection connection(context, options, model);
  std::string trouble;
  const auto run = [&]() -> asio::awaitable<void> {
    trouble = co_await connection.run([&] {
      if (model.is_complete()) connection.close();
    });
  };
  spawn_loop(context.get_executor(), "watch", run());
  context.run_for(kOnceAtMost);
  if (!model.is_complete()) {
    return fail(ExitCode::kNoServer,
                trouble.empty() ? options.address.text + " does not answer" : trouble);
  }
  const bool lacks_lines = options.shows_lines && !model.known().lines;
  if (!model.known().state || lacks_lines)
    return fail(ExitCode::kBadInput, model.known().last_message);
  const Link link{Link::Phase::kLive, options.address.text, ""};
  const TerminalSize size = terminal_size();
  const Page page = options.shows_lines ? Page::kPrintLines : Page::kPrint;
  print_text(text_of(watch::watch_screen(model.known(), link, page, size.rows, size.columns),
                     letters_of(options, Letters::kUnicode)));
  return ExitCode::kGood;
}

}  // namespace

ExitCode run_command(const WatchOptions& options) {
  ignore_signals_of_writing();
  return options.is_once || !is_terminal() ? watch_once(options) : watch_on(options);
}

}  // namespace xr3
