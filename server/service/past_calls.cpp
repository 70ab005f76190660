#include "server/service/past_calls.hpp"

#include <algorithm>
#include <deque>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/frames.hpp"
#include "cell/history/past.hpp"
#include "cell/history/trace.hpp"
#include "protocol/explain/event_report.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxMarks = 500;
constexpr Tick kMostStates = 500;           ///< that a trace looks at; it gives those that differ
constexpr std::int64_t kEventsAtOnce = 64;  ///< some 5 us each

call::Refused no_history(const HostedCell& at) {
  const bool has_device = at.cell().device() != nullptr;
  return {"no_history", "this cell keeps no history",
          has_device ? "a cell with a physical controller has none"
                     : "start the server without --history 0"};
}

std::string span_text(const EpochSpan& span) {
  return "epoch " + std::to_string(span.epoch) + " from tick " + std::to_string(span.from) +
         " to " + std::to_string(span.to);
}

call::Refused not_kept(const ReplayTime& time, const std::vector<EpochSpan>& spans) {
  const std::string wanted =
      "tick " + std::to_string(time.tick) + " of epoch " + std::to_string(time.epoch);
  if (spans.empty()) return {"not_kept", wanted + " is not kept", "no input has acted yet"};
  const auto same = std::ranges::find(spans, time.epoch, &EpochSpan::epoch);
  const std::string hint =
      same != spans.end()
          ? span_text(*same) + " is kept"
          : "the call history lists what is kept: " + span_text(spans.front()) + ", and later";
  return {"not_kept", wanted + " is not kept", hint};
}

// --- The history.

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

Json spans_json(const std::vector<EpochSpan>& spans) {
  Json list = Json::array();
  for (const EpochSpan& span : spans)
    list.push_back({{"epoch", span.epoch}, {"from", span.from}, {"to", span.to}});
  return list;
}

/// The latest notable events in the history, the oldest first. Others are served between pieces.
asio::awaitable<Json> latest_marks(HostedCell& at, std::vector<EpochSpan> spans) {
  const Cell& cell = at.cell();
  std::deque<Json> marks;
  const std::int64_t end = at.cell().events().next();
  for (std::int64_t seq = 0;;) {
    std::vector<CellEvent> events;
    seq = cell.copy_events(seq, kEventsAtOnce, events);
    for (const CellEvent& event : events)
      if (is_kept(event, spans) && is_notable(event, cell.model()))
        marks.push_back(mark_json(event, cell.model()));
    while (marks.size() > kMaxMarks) marks.pop_front();
    if (seq >= end) co_return Json(marks);
    co_await at.transports().pause();
  }
}

// --- A time of the past, made in the worker.

struct Made {
  MachineSnapshotPtr machine;
  ReplayTime time;
  std::vector<monitor::Message> frames;
  std::optional<Difference> difference;
};

Made make(const recording::Header& header, const HistoryPart& part, const ReplayTime& time,
          const std::vector<monitor::Selection>& selections) {
  Past past = make_past(header, part, time);
  Cell& cell = *past.cell;
  Made made;
  made.difference = std::move(past.difference);
  if (made.difference) return made;
  made.machine =
      std::make_shared<const MachineSnapshot>(MachineSnapshot{cell.model_ptr(), cell.state()});
  made.time = {cell.epoch(), cell.state().tick};
  FrameCache frames(cell);
  for (const monitor::Selection& selection : selections) {
    if (const monitor::Frame* frame = frames.frame(selection))
      made.frames.push_back(frame->message);
  }
  return made;
}

ReplayTime time_of(const monitor::PastTime& wanted, const CallOf& of) {
  return {wanted.epoch.value_or(of.cell().epoch()), wanted.tick};
}

/// Whether the cell keeps a history; refuses the call if not.
bool has_history(const CallOf& of) {
  of.cell().catch_up(wall_now());
  if (of.at->history() != nullptr) return true;
  of.session.send(refused(of.id(), no_history(*of.at)));
  return false;
}

}  // namespace

/// A time of a cell's past.
struct PastCalls::Moment {
  MachineSnapshotPtr machine;
  ReplayTime wanted;
  ReplayTime time;
  std::vector<monitor::Message> frames;
};

/// Calls `work` in the worker with the part of the history from which a time can be made, and the
/// last tick of the part. Sends the error and gives nothing if the time is not kept.
template <class Work>
asio::awaitable<std::optional<std::invoke_result_t<Work, const HistoryPart&, Tick>>>
PastCalls::make_from(CallOf of, ReplayTime time, Work work) {
  const CellPtr& at = of.at;
  const auto refuse = [&](const call::Refused& why) { of.session.send(refused(of.id(), why)); };
  co_await making_.until_free();
  const Exclusive::Hold hold(making_);
  const HistoryPartPtr part = at->is_retired() ? nullptr : at->history()->part_before(time);
  if (!part) {
    refuse(not_kept(time, at->history()->epochs()));
    co_return std::nullopt;
  }
  auto job = [part, end = at->history()->end_of_part(time), work = std::move(work)] {
    return work(*part, end);
  };
  auto made = co_await worker_.run(std::move(job));
  if (made.difference) {
    refuse({"not_repeatable", "the history does not fit itself: " + to_text(*made.difference),
            "this is a defect of xr3; please report it with this message"});
  } else if (at->is_retired()) {
    of.session.send(sessions_.unknown_cell(of.session, of.request));
  } else if (!at->history()->covers(time)) {
    refuse(not_kept(time, at->history()->epochs()));
  } else {
    co_return made;
  }
  co_return std::nullopt;
}

asio::awaitable<std::optional<PastCalls::Moment>> PastCalls::make_moment(
    CallOf of, monitor::PastTime wanted, std::vector<monitor::Selection> selections) {
  if (!has_history(of)) co_return std::nullopt;
  const ReplayTime time = time_of(wanted, of);
  auto work = [header = recording_header(of.cell(), ""), time, selections = std::move(selections)](
                  const HistoryPart& part, Tick) { return make(header, part, time, selections); };
  std::optional<Made> made = co_await make_from(of, time, std::move(work));
  if (!made) co_return std::nullopt;
  co_return Moment{std::move(made->machine), time, made->time, std::move(made->frames)};
}

asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::Look& look) {
  const std::optional<Moment> moment = co_await make_moment(of, look.at, look.selections);
  if (!moment) co_return;
  monitor::Client& client = of.session.client();
  client.hold_frames(of.at->name());
  for (const monitor::Message& frame : moment->frames)
    client.send(monitor::as_past(frame, of.id()));
  client.send(
      monitor::result(of.id(), {{"epoch", moment->time.epoch}, {"tick", moment->time.tick}}));
}

// A call gives one part of the history, and a bounded number of states: `next` says where to go on.
asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::Trace& trace) {
  if (!has_history(of)) co_return;
  const ReplayTime from = time_of(trace.from, of);
  auto work = [header = recording_header(of.cell(), ""), from, every = trace.every](
                  const HistoryPart& part, Tick end) {
    const Tick to = std::min(end, from.tick + kMostStates * every);
    return trace_past(header, part, {from.epoch, from.tick, to, every});
  };
  std::optional<PastTrace> traced = co_await make_from(of, from, std::move(work));
  if (!traced) co_return;
  const bool goes_on = of.at->history()->covers({from.epoch, traced->to + 1});
  const Json value = {{"epoch", from.epoch},
                      {"states", std::move(traced->states)},
                      {"next", goes_on ? Json(traced->to + 1) : Json()}};
  of.session.send(monitor::result(of.id(), value));
}

asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::Seek& seek) {
  const std::vector<monitor::Selection> none;
  const std::optional<Moment> moment = co_await make_moment(of, seek.at, none);
  if (!moment) co_return;
  of.cell().apply(Rewind{moment->machine, moment->wanted}, wall_now());
  of.at->after_input();
  of.session.send(monitor::result(of.id(), value_now(of.cell())));
}

asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::Branch& branch) {
  const std::vector<monitor::Selection> none;
  const std::optional<Moment> moment = co_await make_moment(of, branch.at, none);
  if (!moment) co_return;
  const auto opened = open_branch_(*of.at, moment->machine);
  if (const auto* no = std::get_if<call::Refused>(&opened)) {
    of.session.send(refused(of.id(), *no));
    co_return;
  }
  const CellPtr& cell = std::get<CellPtr>(opened);
  Json value = value_now(cell->cell());
  value["cell"] = cell->name();
  value["robot_port"] = cell->port()->endpoint().port();
  if (!cell->token().empty()) value["token"] = cell->token();
  of.session.send(monitor::result(of.id(), value));
}

asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::ReadHistory&) {
  if (!has_history(of)) co_return;
  std::vector<EpochSpan> spans = of.at->history()->epochs();
  Json value = value_now(of.cell());
  value["past"] = of.cell().is_in_past();
  co_await listing_events_.until_free();
  const Exclusive::Hold hold(listing_events_);
  value["epochs"] = spans_json(spans);
  Json marks = co_await latest_marks(*of.at, std::move(spans));
  value["events"] = std::move(marks);
  of.session.send(monitor::result(of.id(), value));
}

asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::Live&) {
  of.cell().catch_up(wall_now());
  of.session.send(monitor::result(of.id(), value_now(of.cell())));
  of.session.client().release_frames(of.at->name());
  of.at->hub().changed();
  co_return;
}

}  // namespace xr3
