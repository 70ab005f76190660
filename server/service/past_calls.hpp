// The calls of monitor sessions on the past of a cell: `history`, `look`, `trace`, `live`,
// `seek` and `branch`. A time of the past is made in the worker, one at a time.
#pragma once

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "server/net/asio.hpp"
#include "server/net/exclusive.hpp"
#include "server/net/worker.hpp"
#include "server/service/calls.hpp"
#include "server/service/sessions.hpp"
#include "service/past.hpp"

namespace xr3 {

class PastCalls {
 public:
  /// The references must outlive it.
  PastCalls(asio::io_context& io, Worker& worker, const MonitorSessions& sessions)
      : worker_(worker), sessions_(sessions), making_(io), listing_events_(io) {}

  /// Opens the cells of the call `branch`: a cell that begins with this state of another one, or
  /// the refusal.
  using OpenBranch =
      std::function<std::variant<CellPtr, call::Refused>(HostedCell& of, MachineSnapshotPtr past)>;
  void branch_by(OpenBranch open) { open_branch_ = std::move(open); }

  // Each answers the call itself.
  asio::awaitable<void> carry_out(CallOf of, const monitor::ReadHistory&);
  asio::awaitable<void> carry_out(CallOf of, const monitor::Look& look);
  asio::awaitable<void> carry_out(CallOf of, const monitor::Trace& trace);
  static asio::awaitable<void> carry_out(CallOf of, const monitor::Live&);
  asio::awaitable<void> carry_out(CallOf of, const monitor::Seek& seek);
  asio::awaitable<void> carry_out(CallOf of, const monitor::Branch& branch);

 private:
  template <class Work>
  asio::awaitable<std::optional<std::invoke_result_t<Work, const HistoryPart&, Tick>>> make_from(
      CallOf of, ReplayTime time, Work work);
  asio::awaitable<std::optional<service::Moment>> make_moment(
      CallOf of, ReplayTime time, std::vector<monitor::Selection> selections);

  Worker& worker_;
  const MonitorSessions& sessions_;
  Exclusive making_;          ///< a time of a cell's past; meanwhile others who look wait
  Exclusive listing_events_;  ///< for a call `history`; meanwhile other such calls wait
  OpenBranch open_branch_;
};

}  // namespace xr3
