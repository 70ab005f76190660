// The calls on a cell's past: what they list, and the times of the past that they show. The work
// that takes long needs only a part of the history, so that another thread can do it.
#pragma once

#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cell/history/history.hpp"
#include "cell/history/trace.hpp"
#include "cell/recording/difference.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request.hpp"
#include "protocol/recording/header.hpp"

namespace xr3::service {

// --- Refusals.

/// The cell keeps no history.
call::Refused no_history(const Cell& cell);
call::Refused not_kept(const ReplayTime& time, const std::vector<EpochSpan>& spans);
/// The history does not fit itself.
call::Refused not_repeatable(const Difference& difference);

// --- What is kept.

Json spans_json(const std::vector<EpochSpan>& spans);

/// The latest notable events in some spans, the oldest first; for a time bar.
class LatestMarks {
 public:
  /// Begins with the oldest event that the cell has.
  explicit LatestMarks(std::vector<EpochSpan> spans) : spans_(std::move(spans)) {}

  /// Looks at the next few events, in some 0.3 ms. Returns whether there are more.
  bool look_on(Cell& cell);
  Json list() const { return Json(marks_); }

 private:
  std::vector<EpochSpan> spans_;
  std::optional<std::int64_t> end_;
  std::int64_t seq_ = 0;
  std::deque<Json> marks_;
};

// --- Times of the past.

/// A call's time, in the current epoch if it names none.
ReplayTime time_of(const monitor::PastTime& wanted, const Cell& cell);

/// A time of a cell's past.
struct Moment {
  MachineSnapshotPtr machine;
  ReplayTime time;                         ///< as late as whole inputs of the byte clock require
  std::vector<monitor::Message> frames;    ///< of the selections
  std::optional<Difference> difference{};  ///< set if the history does not fit itself: a defect
};

/// The cell at a time, and the frames that it had. `header` is that of a recording of the cell. For
/// any thread. Precondition: `part` is what History::part_before() gave for the time.
Moment make_moment(const recording::Header& header, const HistoryPart& part, const ReplayTime& time,
                   const std::vector<monitor::Selection>& selections);

/// The states of a `trace` as far as one call gives them: at most 500, of one part. Preconditions:
/// those of trace_past().
PastTrace make_trace(const recording::Header& header, const HistoryPart& part, Tick end_of_part,
                     const ReplayTime& from, Tick every);
/// The answer's value: the states, and where a further call goes on if the history does.
Json trace_json(PastTrace traced, Epoch epoch, const History& history);

}  // namespace xr3::service
