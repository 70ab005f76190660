#include "cli/term/session.hpp"

#include <array>
#include <filesystem>
#include <utility>

#include "protocol/text/text_stream.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxChunk = 256;
/// A reply of unknown length ends when no byte has come for this time.
constexpr std::chrono::milliseconds kBurstEnd{250};
/// Waiting time for a peer that does not end the line although nothing more will be sent.
constexpr std::chrono::milliseconds kLastWords{500};

std::string text_of_seconds(std::chrono::milliseconds time) {
  TextStream text;
  text << static_cast<double>(time.count()) / 1000 << " s";
  return text.str();
}

}  // namespace

TermSession::TermSession(asio::io_context& context, TermPeer& peer, std::string peer_name,
                         const ReplyContext& robot, Limits limits, TermListener& listener)
    : context_(context),
      peer_(peer),
      peer_name_(std::move(peer_name)),
      limits_(limits),
      listener_(listener),
      decoder_(robot),
      woken_(context),
      sent_(context, asio::steady_timer::time_point::max()),
      timeout_(context),
      burst_(context),
      last_words_(context) {
  peer_.when_protocol([this] { wake(); });
}

void TermSession::start() {
  spawn_loop(context_.get_executor(), "term", read_loop());
  spawn_loop(context_.get_executor(), "term", write_loop());
}

// --- The queue of sources to send.

void TermSession::send(std::string_view bytes) {
  const bool goes_on = !sources_.empty() && !sources_.back().file && !sources_.back().is_break;
  if (!goes_on) sources_.emplace_back();
  sources_.back().bytes += bytes;
  wake();
}

void TermSession::send_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return listener_.say(path + ": there is no such file");
  if (!std::filesystem::is_regular_file(status)) return listener_.say(path + ": not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) return listener_.say(path + ": the file cannot be read");
  sources_.push_back({{}, std::move(file), path});
  wake();
}

void TermSession::send_break() {
  sources_.push_back({});
  sources_.back().is_break = true;
  wake();
}

asio::awaitable<void> TermSession::when_sent() {
  while (!sources_.empty()) co_await sent_.async_wait(kAwait);
}

void TermSession::finish() {
  is_finishing_ = true;
  restart_timeout();
  wake();
}

bool TermSession::may_send() const {
  return !peer_.is_suspended() && decoder_.unanswered() < term::LineDecoder::kMaxUnanswered;
}

/// The next bytes to send; empty if there are none now.
std::string TermSession::next_chunk() {
  while (!sources_.empty() && may_send()) {
    Source& source = sources_.front();
    if (source.is_break) return {};
    std::string chunk = source.file ? next_of_file(source) : source.bytes.substr(0, kMaxChunk);
    if (!source.file) source.bytes.erase(0, chunk.size());
    if (!chunk.empty()) return chunk;
    // The report of the end stands below the replies.
    if (source.file && decoder_.unanswered() > 0) return {};
    report_sent_file(source);
    sources_.pop_front();
  }
  return {};
}

std::string TermSession::next_of_file(Source& source) {
  std::array<char, kMaxChunk> buffer{};
  source.file->read(buffer.data(), buffer.size());
  const auto size = static_cast<std::size_t>(source.file->gcount());
  source.sent += size;
  return {buffer.data(), size};
}

void TermSession::report_sent_file(const Source& source) {
  if (!source.file) return;
  const std::string amount = std::to_string(source.sent) + " bytes";
  listener_.say(source.file->bad() ? source.path + ": the file cannot be read after " + amount
                                   : "sent " + source.path + ": " + amount);
}

// --- The two loops.

asio::awaitable<void> TermSession::write_loop() {
  for (;;) {
    const bool has_written = co_await write_next();
    if (has_written) continue;
    if (sources_.empty()) sent_.cancel();
    const bool is_done = sources_.empty() && decoder_.unanswered() == 0;
    if (is_finishing_ && is_done && !is_input_ended_) end_input();
    woken_.expires_at(asio::steady_timer::time_point::max());
    if (!is_wake_pending_) co_await woken_.async_wait(kAwait);
    is_wake_pending_ = false;
  }
}

/// Sends the next bytes or break. False if there is nothing to send now.
asio::awaitable<bool> TermSession::write_next() {
  const std::string chunk = next_chunk();
  const bool is_break = chunk.empty() && !sources_.empty() && sources_.front().is_break;
  if (is_break && may_send()) {
    sources_.pop_front();
    const std::string trouble = co_await peer_.send_break();
    listener_.say(trouble.empty() ? "break sent" : "break: " + trouble);
    co_return true;
  }
  if (chunk.empty() && !peer_.has_protocol_bytes()) co_return false;
  const std::vector<std::string> ignored = decoder_.send(chunk);
  if (!chunk.empty()) listener_.note_sent(chunk, ignored);
  is_writing_ = true;
  restart_timeout();
  const bool is_sent = co_await peer_.write(chunk);
  is_writing_ = false;
  if (!is_sent) lose_peer();
  restart_timeout();
  co_return is_sent;
}

asio::awaitable<void> TermSession::read_loop() {
  for (;;) {
    const std::string_view bytes = co_await peer_.read();
    if (bytes.empty()) break;
    restart_timeout();
    if (!has_received_) warn_of_monitor_port(bytes);
    has_received_ = true;
    const std::vector<std::string> replies = decoder_.receive(bytes);
    listener_.note_received(bytes, replies);
    if (decoder_.is_in_burst()) restart_burst();
    wake();
  }
  lose_peer();
}

// Warns if the port is a monitor port, which answers robot commands as a bad request; its bytes
// would be decoded as replies.
void TermSession::warn_of_monitor_port(std::string_view first_bytes) {
  const bool is_one = first_bytes.starts_with("HTTP/1.") || first_bytes.starts_with("{\"op\":");
  if (is_one) listener_.say(peer_name_ + " is no robot port; that of xr3 serve is usually 9600");
}

void TermSession::wake() {
  is_wake_pending_ = true;
  woken_.cancel();
}

// --- The end.

/// Ends after everything is sent and answered. A simulated robot ends the line when every byte has
/// been executed.
void TermSession::end_input() {
  is_input_ended_ = true;
  if (!peer_.finish()) return stop(exit_code_);
  run_after(last_words_, kLastWords, [this] { stop(exit_code_); });
}

void TermSession::lose_peer() {
  if (is_input_ended_) return stop(exit_code_);
  listener_.say("the connection to " + peer_name_ + " has ended");
  stop(ExitCode::kNoServer);
}

void TermSession::stop(ExitCode code) {
  exit_code_ = code;
  context_.stop();
}

// --- Time.

void TermSession::restart_timeout() {
  run_after(timeout_, limits_.timeout, [this] { note_timeout(); });
}

void TermSession::note_timeout() {
  const std::string within = " within " + text_of_seconds(limits_.timeout);
  for (const std::string& overdue : decoder_.give_up()) {
    listener_.say(overdue + within + ": is the simulator disabled (A@), or the robot off?");
    exit_code_ = ExitCode::kNoServer;
  }
  const bool is_stuck = is_writing_ || peer_.is_suspended();
  if (is_stuck && limits_.gives_up_sending) {
    listener_.say(peer_name_ + " has accepted no byte" + within);
    return stop(ExitCode::kNoServer);
  }
  wake();
}

void TermSession::restart_burst() {
  run_after(burst_, kBurstEnd, [this] {
    listener_.note_received({}, decoder_.end_of_burst());
    wake();
  });
}

}  // namespace xr3
