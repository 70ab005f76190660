#include "service/past.hpp"

#include <algorithm>
#include <utility>

#include "cell/frames.hpp"
#include "cell/history/past.hpp"
#include "protocol/explain/event_report.hpp"

namespace xr3::service {
namespace {

constexpr std::size_t kMaxMarks = 500;
constexpr Tick kMostStates = 500;           ///< that a trace looks at; it gives those that differ
constexpr std::int64_t kEventsAtOnce = 64;  ///< some 5 us each

std::string span_text(const EpochSpan& span) {
  return "epoch " + std::to_string(span.epoch) + " from tick " + std::to_string(span.from) +
         " to " + std::to_string(span.to);
}

/// Whether a time bar should show it: not the ordinary course of motion.
bool is_notable(const CellEvent& event, const Model& model) {
  const std::string_view kind = report(event, model).event;
  return kind != "move" && kind != "reached";
}

Json mark_json(const CellEvent& event, const Model& model) {
  const EventReport told = report(event, model);
  return {{"epoch", event.epoch},
          {"tick", event.tick},
          {"event", told.event},
          {"code", told.code},
          {"message", told.message}};
}

bool is_kept(const CellEvent& event, const std::vector<EpochSpan>& spans) {
  return std::any_of(spans.begin(), spans.end(), [&event](const EpochSpan& span) {
    return span.epoch == event.epoch && span.from <= event.tick && event.tick <= span.to;
  });
}

}  // namespace

// --- Refusals.

call::Refused no_history(const Cell& cell) {
  return {"no_history", "this cell keeps no history",
          cell.device() != nullptr ? "a cell with a physical controller has none"
                                   : "start the server without --history 0"};
}

call::Refused not_kept(const ReplayTime& time, const std::vector<EpochSpan>& spans) {
  const std::string wanted =
      "tick " + std::to_string(time.tick) + " of epoch " + std::to_string(time.epoch);
  if (spans.empty()) return {"not_kept", wanted + " is not kept", "no input has acted yet"};
  const auto same = std::find_if(spans.begin(), spans.end(), [&time](const EpochSpan& span) {
    return span.epoch == time.epoch;
  });
  const std::string hint =
      same != spans.end()
          ? span_text(*same) + " is kept"
          : "the call history lists what is kept: " + span_text(spans.front()) + ", and later";
  return {"not_kept", wanted + " is not kept", hint};
}

call::Refused not_repeatable(const Difference& difference) {
  return {"not_repeatable", "the history does not fit itself: " + to_text(difference),
          "this is a defect of xr3; please report it with this message"};
}

// --- What is kept.

Json spans_json(const std::vector<EpochSpan>& spans) {
  Json list = Json::array();
  for (const EpochSpan& span : spans)
    list.push_back({{"epoch", span.epoch}, {"from", span.from}, {"to", span.to}});
  return list;
}

bool LatestMarks::look_on(Cell& cell) {
  if (!end_) end_ = cell.events().next();
  std::vector<CellEvent> events;
  seq_ = cell.copy_events(seq_, kEventsAtOnce, events);
  for (const CellEvent& event : events)
    if (is_kept(event, spans_) && is_notable(event, cell.model()))
      marks_.push_back(mark_json(event, cell.model()));
  while (marks_.size() > kMaxMarks) marks_.pop_front();
  return seq_ < *end_;
}

// --- Times of the past.

ReplayTime time_of(const monitor::PastTime& wanted, const Cell& cell) {
  return {wanted.epoch.value_or(cell.epoch()), wanted.tick};
}

Moment make_moment(const recording::Header& header, const HistoryPart& part, const ReplayTime& time,
                   const std::vector<monitor::Selection>& selections) {
  Past past = make_past(header, part, time);
  Cell& cell = *past.cell;
  if (past.difference) return {nullptr, time, {}, std::move(past.difference)};
  Moment moment{
      std::make_shared<const MachineSnapshot>(MachineSnapshot{cell.model_ptr(), cell.state()}),
      {cell.epoch(), cell.state().tick},
      {}};
  FrameCache frames(cell);
  for (const monitor::Selection& selection : selections) {
    if (const monitor::Frame* frame = frames.frame(selection))
      moment.frames.push_back(frame->message);
  }
  return moment;
}

PastTrace make_trace(const recording::Header& header, const HistoryPart& part, Tick end_of_part,
                     const ReplayTime& from, Tick every) {
  const Tick to = std::min(end_of_part, from.tick + kMostStates * every);
  return trace_past(header, part, {from.epoch, from.tick, to, every});
}

Json trace_json(PastTrace traced, Epoch epoch, const History& history) {
  const bool goes_on = history.covers({epoch, traced.to + 1});
  return {{"epoch", epoch},
          {"states", std::move(traced.states)},
          {"next", goes_on ? Json(traced.to + 1) : Json()}};
}

}  // namespace xr3::service
