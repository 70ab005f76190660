#include "server/recording/recorded_end.hpp"

#include <cassert>
#include <utility>

#include "cell/recording/continued.hpp"
#include "cell/recording/recorder.hpp"
#include "protocol/json/finding.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

constexpr WallNs kNsPerMinute = 60'000'000'000;

/// The first of the findings, without the line feed.
std::string first_of(const DataError& error) { return to_text(error.findings().front()); }

}  // namespace

bool RecordedEnd::work(WallNs time) {
  const WallNs begin = wall_now();
  try {
    if (!source_) open();
    if (apply(begin + time)) return true;
    worked_ += wall_now() - begin;
    if (worked_ < kMostWork) return false;
    why_ = path_ + ": it takes longer than " + std::to_string(kMostWork / kNsPerMinute) +
           " minutes to repeat";
  } catch (const DataError& error) {
    why_ = first_of(error);
  } catch (const std::exception& error) {
    why_ = error.what();
  }
  return true;
}

void RecordedEnd::open() {
  source_.emplace(path_);
  const recording::Header header = source_->header();
  if (header.device) throw FileError(path_ + ": it is of a physical controller");
  origin_ = origin_of(header);
  cell_ = std::make_unique<Cell>(header.cell, header.model, replay_clock(header), &rings_);
  prepare_replay(*cell_, header);
  const bool has_digests = header.state_format == kStateFormat;
  replayer_.emplace(*cell_, has_digests ? Compared::kAll : Compared::kReplies);
}

/// Repeats entries until this time. Returns whether it was the last one.
bool RecordedEnd::apply(WallNs until) {
  while (wall_now() < until) {
    const auto entry = source_->next();
    if (!entry) {
      close_lines();
      return true;
    }
    if (const auto other = replayer_->apply(*entry))
      throw FileError(path_ + ":" + std::to_string(source_->reader().line()) + ": " +
                      to_text(*other));
  }
  return false;
}

void RecordedEnd::close_lines() {
  while (!cell_->lines().empty())
    cell_->apply(LineClosed{cell_->lines().begin()->first, LineCloseReason::kShutdown}, 0);
  replayer_.reset();
  source_.reset();
}

recording::Header RecordedEnd::header() const {
  assert(why_.empty());
  recording::Header header = recording_header(*cell_, "");
  header.start = continued_state(*cell_, origin_);
  return header;
}

}  // namespace xr3
