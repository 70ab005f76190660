#include "service/cell_monitor.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "protocol/monitor/call_table.hpp"
#include "protocol/monitor/overview.hpp"
#include "service/answer.hpp"
#include "service/calls.hpp"
#include "service/channels.hpp"
#include "service/frames.hpp"
#include "service/lines.hpp"
#include "service/past.hpp"

namespace xr3::service {
namespace {

call::Refused no_server(const std::string& what) {
  return {"no_server", what + " needs a server, and this robot has none", "start xr3 serve"};
}

monitor::CellSummary summary_of(const Cell& cell) {
  monitor::CellSummary summary = monitor::machine_summary(cell.model(), cell.state());
  summary.name = cell.name();
  summary.epoch = cell.epoch();
  summary.lines = cell.lines().size();
  if (!cell.lines().empty()) summary.peer = cell.lines().rbegin()->second.peer();
  return summary;
}

}  // namespace

/// Carries out a request by its type.
struct CellMonitor::Dispatch {
  CellMonitor& at;
  monitor::Request& request;
  WallNs now;

  Cell& cell() const { return *at.cell_; }
  const monitor::RequestId& id() const { return request.id; }
  WatchedCell watched() const {
    cell().catch_up(now);
    return {at.cell_, at.frames_, frame_at(now)};
  }
  void send(monitor::Message message) const { at.client_.send(std::move(message)); }
  void send(const Json& value) const { send(monitor::result(id(), value)); }
  void refuse(const call::Refused& why) const { send(refused(id(), why)); }

  void operator()(const monitor::Ping&) const { send(monitor::pong(id())); }
  void operator()(const monitor::Auth&) const { send(Json{{"access", "control"}}); }
  void operator()(const monitor::Subscribe& wanted) const {
    if (wanted.selection.channel == monitor::Channel::kOverview)
      return refuse(no_server("the channel overview"));
    subscribe(watched(), at.client_, id(), wanted);
  }
  void operator()(const monitor::Unsubscribe& wanted) const {
    if (wanted.channel == monitor::Channel::kOverview)
      return refuse(no_server("the channel overview"));
    unsubscribe(cell().name(), at.client_, id(), wanted);
  }
  void operator()(const monitor::Get& wanted) const {
    if (wanted.selection.channel == monitor::Channel::kOverview)
      return refuse(no_server("the channel overview"));
    get(watched(), at.client_, id(), wanted);
  }
  void operator()(const monitor::CallRequest& wanted) const {
    if (wanted.after) return refuse(no_server("a call that waits for bytes"));
    std::visit([&](const auto& call) { call_by_type(wanted, call); }, wanted.call);
  }

  template <class Call>
  void call_by_type(const monitor::CallRequest& wanted, const Call& call) const {
    const CellCall of{cell(), request, wanted, now};
    if constexpr (requires { service::carry_out(of, call); })
      send(service::carry_out(of, call));
    else
      carry_out(of, call);
  }

  void carry_out(const CellCall& of, const monitor::Send& wanted) const {
    if (const auto why = refuse_send(cell(), at.line_)) return refuse(*why);
    if (!at.line_ || cell().find_line(*at.line_) == nullptr) at.line_ = open_line(cell(), now);
    const Applied applied = cell().apply(BytesIn{*at.line_, wanted.bytes}, now);
    send(sent(of, wanted, *at.line_, applied.bytes_taken));
  }
  void carry_out(const CellCall&, const monitor::DisconnectLine& wanted) const {
    if (cell().find_line(wanted.line) == nullptr) return refuse(no_such_line(wanted.line));
    cell().apply(LineClosed{wanted.line, LineCloseReason::kDisconnected}, now);
    send(value_now(cell()));
  }
  void carry_out(const CellCall&, const monitor::ListCells&) const {
    cell().catch_up(now);
    send(Json{{"cells", Json::array({monitor::summary_json(summary_of(cell()))})},
              {"exercise", nullptr}});
  }
  void carry_out(const CellCall&, const monitor::Describe& wanted) const {
    Json value = value_now(cell());
    value.update(monitor::description(wanted.fn));
    send(value);
  }
  void carry_out(const CellCall&, const monitor::ReleasePeer&) const {
    refuse(no_server("the call peer_release"));
  }
  void carry_out(const CellCall&, const monitor::Branch&) const {
    refuse(no_server("the call branch"));
  }

  // --- The past.

  void carry_out(const CellCall&, const monitor::ReadHistory&) const {
    if (!has_history()) return;
    const std::vector<EpochSpan> spans = at.history_->epochs();
    LatestMarks marks(spans);
    while (marks.look_on(cell())) continue;
    Json value = value_now(cell());
    value["past"] = cell().is_in_past();
    value["epochs"] = spans_json(spans);
    value["events"] = marks.list();
    send(value);
  }
  void carry_out(const CellCall&, const monitor::Look& look) const {
    const std::optional<Moment> moment = moment_at(look.at, look.selections);
    if (!moment) return;
    at.client_.hold_frames(cell().name());
    for (const monitor::Message& frame : moment->frames) send(monitor::as_past(frame, id()));
    send(Json{{"epoch", moment->time.epoch}, {"tick", moment->time.tick}});
  }
  void carry_out(const CellCall&, const monitor::Live&) const {
    cell().catch_up(now);
    send(value_now(cell()));
    at.client_.release_frames(cell().name());
  }
  void carry_out(const CellCall&, const monitor::Seek& seek) const {
    const std::optional<Moment> moment = moment_at(seek.at, {});
    if (!moment) return;
    cell().apply(Rewind{moment->machine, time_of(seek.at, cell())}, now);
    send(value_now(cell()));
  }
  void carry_out(const CellCall&, const monitor::Trace& trace) const {
    if (!has_history()) return;
    const ReplayTime from = time_of(trace.from, cell());
    const HistoryPartPtr part = part_before(from);
    if (!part) return;
    const Tick end = at.history_->end_of_part(from);
    PastTrace traced = make_trace(recording_header(cell(), ""), *part, end, from, trace.every);
    if (traced.difference) return refuse(not_repeatable(*traced.difference));
    send(trace_json(std::move(traced), from.epoch, *at.history_));
  }

  /// Refuses the request if the cell keeps no history.
  bool has_history() const {
    cell().catch_up(now);
    if (at.history_ != nullptr) return true;
    refuse(no_history(cell()));
    return false;
  }
  /// Refuses the request, with nullptr, if the time is not kept.
  HistoryPartPtr part_before(const ReplayTime& time) const {
    HistoryPartPtr part = at.history_->part_before(time);
    if (!part) refuse(not_kept(time, at.history_->epochs()));
    return part;
  }
  std::optional<Moment> moment_at(const monitor::PastTime& wanted,
                                  const std::vector<monitor::Selection>& selections) const {
    if (!has_history()) return std::nullopt;
    const ReplayTime time = time_of(wanted, cell());
    const HistoryPartPtr part = part_before(time);
    if (!part) return std::nullopt;
    Moment moment = make_moment(recording_header(cell(), ""), *part, time, selections);
    if (!moment.difference) return moment;
    refuse(not_repeatable(*moment.difference));
    return std::nullopt;
  }
};

CellMonitor::CellMonitor(const std::string& product, std::shared_ptr<Cell> cell,
                         const History* history)
    : cell_(std::move(cell)), history_(history), frames_(*cell_) {
  const monitor::CellTime now{cell_->epoch(), cell_->state().tick, cell_->clock().mode(),
                              cell_->clock().rate()};
  const monitor::GreetedCell greeted{cell_->name(), cell_->model(), now};
  client_.send(monitor::hello({product, {cell_->name()}, greeted, monitor::Access::kControl}));
}

void CellMonitor::handle(std::string_view message, WallNs now) {
  if (is_full()) return;
  std::optional<monitor::Request> request = client_.handle(message);
  if (!request) return;
  const Dispatch dispatch{*this, *request, now};
  if (request->cell && *request->cell != cell_->name())
    return client_.send(monitor::result(monitor::unknown_cell(*request, {cell_->name()})));
  std::visit(dispatch, request->what);
}

void CellMonitor::offer_frames(WallNs now) {
  cell_->catch_up(now);
  offer_due_frames(client_, cell_->name(), frames_, frame_at(now));
}

monitor::Message CellMonitor::next_output(WallNs now) { return client_.next_output(frame_at(now)); }

}  // namespace xr3::service
