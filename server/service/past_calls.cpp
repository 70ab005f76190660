#include "server/service/past_calls.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "server/net/wall_clock.hpp"
#include "service/answer.hpp"
#include "service/past.hpp"

namespace xr3 {
namespace {

/// The latest notable events in the history. Others are served between pieces.
asio::awaitable<Json> latest_marks(HostedCell& at, std::vector<EpochSpan> spans) {
  service::LatestMarks marks(std::move(spans));
  bool goes_on = true;
  while (goes_on) {
    goes_on = marks.look_on(at.cell());
    if (goes_on) co_await at.transports().pause();
  }
  co_return marks.list();
}

/// Whether the cell keeps a history; refuses the call if not.
bool has_history(const CallOf& of) {
  of.cell().catch_up(wall_now());
  if (of.at->history() != nullptr) return true;
  of.session.send(service::refused(of.id(), service::no_history(of.cell())));
  return false;
}

}  // namespace

/// Calls `work` in the worker with the part of the history from which a time can be made, and the
/// last tick of the part. Sends the error and gives nothing if the time is not kept.
template <class Work>
asio::awaitable<std::optional<std::invoke_result_t<Work, const HistoryPart&, Tick>>>
PastCalls::make_from(CallOf of, ReplayTime time, Work work) {
  const CellPtr& at = of.at;
  const auto refuse = [&](const call::Refused& why) {
    of.session.send(service::refused(of.id(), why));
  };
  co_await making_.until_free();
  const Exclusive::Hold hold(making_);
  const HistoryPartPtr part = at->is_retired() ? nullptr : at->history()->part_before(time);
  if (!part) {
    refuse(service::not_kept(time, at->history()->epochs()));
    co_return std::nullopt;
  }
  auto job = [part, end = at->history()->end_of_part(time), work = std::move(work)] {
    return work(*part, end);
  };
  auto made = co_await worker_.run(std::move(job));
  if (made.difference) {
    refuse(service::not_repeatable(*made.difference));
  } else if (at->is_retired()) {
    of.session.send(sessions_.unknown_cell(of.session, of.request));
  } else if (!at->history()->covers(time)) {
    refuse(service::not_kept(time, at->history()->epochs()));
  } else {
    co_return made;
  }
  co_return std::nullopt;
}

asio::awaitable<std::optional<service::Moment>> PastCalls::make_moment(
    CallOf of, ReplayTime time, std::vector<monitor::Selection> selections) {
  if (!has_history(of)) co_return std::nullopt;
  auto work = [header = recording_header(of.cell(), ""), time, selections = std::move(selections)](
                  const HistoryPart& part, Tick) {
    return service::make_moment(header, part, time, selections);
  };
  co_return co_await make_from(of, time, std::move(work));
}

asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::Look& look) {
  const ReplayTime time = service::time_of(look.at, of.cell());
  const auto moment = co_await make_moment(of, time, look.selections);
  if (!moment) co_return;
  monitor::Client& client = of.session.client();
  client.hold_frames(of.at->name());
  for (const monitor::Message& frame : moment->frames)
    client.send(monitor::as_past(frame, of.id()));
  client.send(
      monitor::result(of.id(), {{"epoch", moment->time.epoch}, {"tick", moment->time.tick}}));
}

asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::Trace& trace) {
  if (!has_history(of)) co_return;
  const ReplayTime from = service::time_of(trace.from, of.cell());
  auto work = [header = recording_header(of.cell(), ""), from, every = trace.every](
                  const HistoryPart& part, Tick end) {
    return service::make_trace(header, part, end, from, every);
  };
  std::optional<PastTrace> traced = co_await make_from(of, from, std::move(work));
  if (!traced) co_return;
  const Json value = service::trace_json(std::move(*traced), from.epoch, *of.at->history());
  of.session.send(monitor::result(of.id(), value));
}

asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::Seek& seek) {
  const ReplayTime time = service::time_of(seek.at, of.cell());
  const std::vector<monitor::Selection> none;
  const auto moment = co_await make_moment(of, time, none);
  if (!moment) co_return;
  of.cell().apply(Rewind{moment->machine, time}, wall_now());
  of.at->after_input();
  of.session.send(monitor::result(of.id(), service::value_now(of.cell())));
}

asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::Branch& branch) {
  const ReplayTime time = service::time_of(branch.at, of.cell());
  const std::vector<monitor::Selection> none;
  const auto moment = co_await make_moment(of, time, none);
  if (!moment) co_return;
  const auto opened = open_branch_(*of.at, moment->machine);
  if (const auto* no = std::get_if<call::Refused>(&opened)) {
    of.session.send(service::refused(of.id(), *no));
    co_return;
  }
  const CellPtr& cell = std::get<CellPtr>(opened);
  Json value = service::value_now(cell->cell());
  value["cell"] = cell->name();
  value["robot_port"] = cell->port()->endpoint().port();
  if (!cell->token().empty()) value["token"] = cell->token();
  of.session.send(monitor::result(of.id(), value));
}

asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::ReadHistory&) {
  if (!has_history(of)) co_return;
  std::vector<EpochSpan> spans = of.at->history()->epochs();
  Json value = service::value_now(of.cell());
  value["past"] = of.cell().is_in_past();
  co_await listing_events_.until_free();
  const Exclusive::Hold hold(listing_events_);
  value["epochs"] = service::spans_json(spans);
  Json marks = co_await latest_marks(*of.at, std::move(spans));
  value["events"] = std::move(marks);
  of.session.send(monitor::result(of.id(), value));
}

asio::awaitable<void> PastCalls::carry_out(CallOf of, const monitor::Live&) {
  of.cell().catch_up(wall_now());
  of.session.send(monitor::result(of.id(), service::value_now(of.cell())));
  of.session.client().release_frames(of.at->name());
  of.at->hub().changed();
  co_return;
}

}  // namespace xr3
