#include "server/recording/recording.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>
#include <cassert>
#include <chrono>
#include <utility>

#include "cell/failure.hpp"
#include "cell/recording/continued.hpp"
#include "server/files/data_files.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

// Maximum time until an input is in the file.
constexpr std::chrono::milliseconds kFlushAfter{100};
// Size reserved for the last line of a recording that has reached its limit.
constexpr std::uint64_t kRoomForEnd = 200;
constexpr std::uint64_t kMebibyte = 1U << 20U;

}  // namespace

Recording::Recording(asio::io_context& io, Cell& cell, std::string path, RecordingLimits limits,
                     std::function<void()> on_input)
    : io_(io),
      cell_(cell),
      path_(std::move(path)),
      limits_(limits),
      on_input_(std::move(on_input)),
      origin_(cell.value().origin),
      recorder_([this](const recording::Entry& entry) { add(entry); }),
      timer_(io),
      last_{0, 0, 0, recording::End{"", "limit"}} {
  begin();
  if (!is_over_) cell_.observe(recorder_);
}

Recording::~Recording() { cell_.end_observation(recorder_); }

void Recording::begin() {
  const std::string header = header_line();
  std::string why = refusal(header.size());
  if (why.empty()) why = shortage();
  if (!why.empty()) {
    fail(std::move(why));
    return;
  }
  begin_file(header);
}

void Recording::go_on_in(const std::function<std::string()>& new_path) {
  assert(cell_.lines().empty());
  if (is_over_) return;
  end_file();
  try {
    path_ = new_path();
    writer_ = {};
    last_ = recorder_.end_of(cell_, "limit");
    begin();
  } catch (const FileError& error) {
    fail(error.what());
  }
}

std::string Recording::header_line() {
  recording::Header header = recording_header(cell_, "xr3 " XR3_VERSION);
  if (origin_.empty())
    origin_ = origin_of(header);
  else
    header.start = continued_state(cell_, origin_);
  std::string line = writer_.line(header);
  if (line.size() > recording::kMaxLine || line.size() + kRoomForEnd > limits_.max_bytes)
    throw FileError(path_ + ": robot and workcell are too large for the recording");
  return line;
}

// Makes the file. The first line reveals at once whether the file can be written.
void Recording::begin_file(const std::string& header) {
  file_.emplace(path_);
  file_->add(header);
  file_->flush();
  if (!file_->failure().empty())
    throw FileError(path_ + ": the recording cannot be written: " + file_->failure());
  if (limits_.room != nullptr) limits_.room->take(header.size() + kRoomForEnd);
}

void Recording::add(const recording::Entry& entry) {
  if (is_over_) return;
  recording::RecordingWriter next = writer_;
  const std::string line = next.line(entry);
  if (std::string why = refusal(line.size()); !why.empty()) return end_early(std::move(why));
  writer_ = next;
  last_.epoch = entry.epoch;
  last_.tick = entry.tick;
  last_.us = entry.us;
  if (limits_.room != nullptr) limits_.room->take(line.size());
  add_line(line);
}

/// The reason why a line of this size must not be added; empty if it may.
std::string Recording::refusal(std::uint64_t bytes) const {
  const std::uint64_t size = file_ ? file_->size() : 0;
  if (bytes > recording::kMaxLine || size + bytes + kRoomForEnd > limits_.max_bytes)
    return "it has reached its maximum of " + std::to_string(limits_.max_bytes / kMebibyte) +
           " MiB (--record-max)";
  if (limits_.room == nullptr) return {};
  return limits_.room->refusal(file_ ? bytes : bytes + kRoomForEnd);
}

void Recording::add_line(const std::string& line) {
  file_->add(line);
  if (!file_->failure().empty()) return fail(file_->failure());
  flush_soon();
}

void Recording::end_early(std::string why) {
  file_->add(writer_.line(last_));
  file_->flush();
  fail(std::move(why));
}

void Recording::flush_soon() {
  if (std::exchange(is_timer_on_, true)) return;
  run_after(timer_, kFlushAfter, [this] { flush(); });
}

void Recording::flush() {
  is_timer_on_ = false;
  if (is_over_) return;
  file_->flush();
  if (!file_->failure().empty()) return fail(file_->failure());
  if (std::string why = shortage(); !why.empty()) end_early(std::move(why));
}

std::string Recording::shortage() const {
  return limits_.room == nullptr ? "" : limits_.room->shortage(path_, wall_now());
}

// Reports a failure. The cell may be executing an input, so the event is posted.
void Recording::fail(std::string why) {
  if (std::exchange(is_over_, true)) return;
  asio::post(io_, [this, why = std::move(why)] {
    fatal_if_throws("the recording", [&] { report(why); });
  });
}

void Recording::report(const std::string& why) {
  cell_.end_observation(recorder_);
  cell_.apply(RecordingFailed{path_, path_ + ": " + why}, wall_now());
  on_input_();
}

void Recording::finish() {
  cell_.end_observation(recorder_);
  timer_.cancel();
  if (!std::exchange(is_over_, true)) end_file();
}

void Recording::end_file() {
  file_->add(writer_.line(recorder_.end_of(cell_, "stopped")));
  file_->flush();
  if (!file_->failure().empty())
    spdlog::error("{}: the recording cannot be written: {}", path_, file_->failure());
}

}  // namespace xr3
