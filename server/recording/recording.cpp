#include "server/recording/recording.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>
#include <chrono>
#include <utility>

#include "cell/failure.hpp"
#include "server/files/data_files.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

// Input is in the file after this time at the latest.
constexpr std::chrono::milliseconds kFlushAfter{100};
// Kept free for the last line of a recording that has reached its limit.
constexpr std::uint64_t kRoomForEnd = 200;
constexpr std::uint64_t kMebibyte = 1U << 20U;

}  // namespace

Recording::Recording(asio::io_context& io, Cell& cell, std::string path, std::uint64_t max_bytes,
                     std::function<void()> acted)
    : io_(io),
      cell_(cell),
      max_bytes_(max_bytes),
      acted_(std::move(acted)),
      file_(std::move(path)),
      recorder_([this](const recording::Entry& entry) { add(entry); }),
      timer_(io) {
  begin_file();
  cell_.add_log(recorder_);
}

Recording::~Recording() { cell_.remove_log(recorder_); }

// The first line shows at once whether the file can be written.
void Recording::begin_file() {
  const std::string line = writer_.line(recording_header(cell_, "xr3 " XR3_VERSION));
  if (line.size() > recording::kMaxLine || line.size() + kRoomForEnd > max_bytes_)
    throw FileError(file_.path() + ": robot and workcell are too large for the recording");
  file_.add(line);
  file_.flush();
  if (!file_.failure().empty())
    throw FileError(file_.path() + ": the recording cannot be written: " + file_.failure());
}

void Recording::add(const recording::Entry& entry) {
  if (is_over_) return;
  const recording::Entry here{entry.epoch, entry.tick, entry.us, recording::End{"", "limit"}};
  recording::RecordingWriter next = writer_;
  const std::string line = next.line(entry);
  if (file_.size() + line.size() + kRoomForEnd <= max_bytes_ &&
      line.size() <= recording::kMaxLine) {
    writer_ = next;
    last_ = here;
    return add_line(line);
  }
  last_.body = here.body;
  file_.add(writer_.line(last_));
  file_.flush();
  fail("it has reached its maximum of " + std::to_string(max_bytes_ / kMebibyte) +
       " MiB (--record-max)");
}

void Recording::add_line(const std::string& line) {
  file_.add(line);
  if (!file_.failure().empty()) return fail(file_.failure());
  flush_soon();
}

void Recording::flush_soon() {
  if (std::exchange(is_timer_on_, true)) return;
  run_after(timer_, kFlushAfter, [this] { flush(); });
}

void Recording::flush() {
  is_timer_on_ = false;
  file_.flush();
  if (!file_.failure().empty()) fail(file_.failure());
}

// The cell may be in the middle of an input, so the event comes later.
void Recording::fail(std::string why) {
  if (std::exchange(is_over_, true)) return;
  asio::post(io_, [this, why = std::move(why)] { vital("the recording", [&] { report(why); }); });
}

void Recording::report(const std::string& why) {
  cell_.remove_log(recorder_);
  cell_.apply(RecordingFailed{file_.path(), why}, wall_now());
  acted_();
}

void Recording::finish() {
  cell_.remove_log(recorder_);
  timer_.cancel();
  if (std::exchange(is_over_, true)) return;
  file_.add(writer_.line(recorder_.end_of(cell_, "stopped")));
  file_.flush();
  if (!file_.failure().empty())
    spdlog::error("{}: the recording cannot be written: {}", file_.path(), file_.failure());
}

}  // namespace xr3
