// The monitor's calls on the past of a cell: `history`, `look`, `live`, `seek` and `branch`. A time
// of the past is made in the worker, one at a time.
#include <algorithm>
#include <deque>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/frames.hpp"
#include "cell/history/past.hpp"
#include "protocol/explain/event_report.hpp"
#include "server/monitor_port/service.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxMarks = 500;
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

const monitor::PastTime& time_of(const monitor::Request& request) {
  const auto& call = std::get<monitor::CallRequest>(request.what).call;
  if (const auto* look = std::get_if<monitor::Look>(&call)) return look->at;
  if (const auto* seek = std::get_if<monitor::Seek>(&call)) return seek->at;
  return std::get<monitor::Branch>(call).at;
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

}  // namespace

/// A time of a cell's past.
struct MonitorService::Moment {
  MachineSnapshotPtr machine;
  ReplayTime wanted;
  ReplayTime time;
  std::vector<monitor::Message> frames;
};

asio::awaitable<void> MonitorService::call_past(CellPtr at, MonitorSession& session,
                                                monitor::Request request) {
  const monitor::RequestId id = request.id;
  const auto& call = std::get<monitor::CallRequest>(request.what).call;
  at->cell().catch_up(wall_now());
  if (std::holds_alternative<monitor::Live>(call)) {
    end_look(*at, session, id);
    co_return;
  }
  if (at->history() == nullptr) {
    session.send(refused(id, no_history(*at)));
    co_return;
  }
  if (std::holds_alternative<monitor::ReadHistory>(call)) {
    co_await list_history(std::move(at), session, id);
    co_return;
  }
  const auto* look = std::get_if<monitor::Look>(&call);
  const bool is_seek = std::holds_alternative<monitor::Seek>(call);
  std::vector<monitor::Selection> selections;
  if (look != nullptr) selections = look->selections;
  const std::optional<Moment> moment =
      co_await make_moment(at, session, std::move(request), std::move(selections));
  if (!moment) co_return;
  monitor::Client& client = session.client();
  if (is_seek) {
    at->cell().apply(Rewind{moment->machine, moment->wanted}, wall_now());
    at->acted();
    client.send(monitor::result(id, value_now(at->cell())));
  } else if (look == nullptr) {
    client.send(open_branch(*at, *moment, id));
  } else {
    client.hold_frames(at->name());
    for (const monitor::Message& frame : moment->frames) client.send(monitor::as_past(frame, id));
    client.send(monitor::result(id, {{"epoch", moment->time.epoch}, {"tick", moment->time.tick}}));
  }
}

/// Sends the error and gives nothing if the time is not kept.
asio::awaitable<std::optional<MonitorService::Moment>> MonitorService::make_moment(
    CellPtr at, MonitorSession& session, monitor::Request request,
    std::vector<monitor::Selection> selections) {
  const monitor::PastTime& wanted = time_of(request);
  const ReplayTime time{wanted.epoch.value_or(at->cell().epoch()), wanted.tick};
  const auto refuse = [&](const call::Refused& why) { session.send(refused(request.id, why)); };
  co_await making_past_.until_free();
  const Exclusive::Hold hold(making_past_);
  const HistoryPartPtr part = at->is_retired() ? nullptr : at->history()->part_before(time);
  if (!part) {
    refuse(not_kept(time, at->history()->epochs()));
    co_return std::nullopt;
  }
  auto work = [header = recording_header(at->cell(), ""), part, time,
               selections = std::move(selections)] {
    return make(header, *part, time, selections);
  };
  Made made = co_await worker_.run(std::move(work));
  if (made.difference) {
    refuse({"not_repeatable", "the history does not fit itself: " + to_text(*made.difference),
            "this is a defect of xr3; please report it with this message"});
  } else if (at->is_retired()) {
    session.send(unknown_cell(session, request));
  } else if (!at->history()->covers(time)) {
    refuse(not_kept(time, at->history()->epochs()));
  } else {
    co_return Moment{std::move(made.machine), time, made.time, std::move(made.frames)};
  }
  co_return std::nullopt;
}

asio::awaitable<void> MonitorService::list_history(CellPtr at, MonitorSession& session,
                                                   monitor::RequestId id) {
  const Cell& cell = at->cell();
  std::vector<EpochSpan> spans = at->history()->epochs();
  Json value = value_now(cell);
  value["past"] = cell.is_in_past();
  co_await listing_events_.until_free();
  const Exclusive::Hold hold(listing_events_);
  value["epochs"] = spans_json(spans);
  Json marks = co_await latest_marks(*at, std::move(spans));
  value["events"] = std::move(marks);
  session.send(monitor::result(id, value));
}

void MonitorService::end_look(HostedCell& at, MonitorSession& session,
                              const monitor::RequestId& id) {
  session.send(monitor::result(id, value_now(at.cell())));
  session.client().release_frames(at.name());
  at.hub().acted();
}

monitor::Message MonitorService::open_branch(HostedCell& at, const Moment& moment,
                                             const monitor::RequestId& id) {
  const auto opened = open_branch_(at, moment.machine);
  if (const auto* no = std::get_if<call::Refused>(&opened)) return refused(id, *no);
  const CellPtr& cell = std::get<CellPtr>(opened);
  Json value = value_now(cell->cell());
  value["cell"] = cell->name();
  value["robot_port"] = cell->port()->endpoint().port();
  if (!cell->token().empty()) value["token"] = cell->token();
  return monitor::result(id, value);
}

}  // namespace xr3
