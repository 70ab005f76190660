// Requests that concern all cells of the server: the channel `overview`, and the calls `cells` and
// `describe`.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/monitor/call_table.hpp"
#include "server/monitor_port/service.hpp"

namespace xr3 {
asio::awaitable<void> MonitorService::carry_out_overview(MonitorSession& session,
                                                         monitor::Request request) {
  monitor::Client& client = session.client();
  if (const auto* wanted = std::get_if<monitor::Subscribe>(&request.what)) {
    const monitor::MilliHz rate = std::min(wanted->max_millihz, monitor::kMaxOverviewMilliHz);
    client.send(monitor::result(
        request.id, {{"channel", "overview"}, {"max_hz", static_cast<double>(rate) / 1000.0}}));
    client.follow_overview(rate);
    overview_.add(session);
  } else if (std::holds_alternative<monitor::Unsubscribe>(request.what)) {
    client.unfollow_overview();
    overview_.remove(session);
    client.send(monitor::result(request.id, Json::object()));
  } else {
    const std::vector<monitor::CellSummary> cells = co_await overview_.summaries();
    client.send(monitor::with_id(overview_.whole(session, cells), request.id));
  }
}

asio::awaitable<void> MonitorService::list_cells(MonitorSession& session,
                                                 monitor::Request request) {
  const std::vector<monitor::CellSummary> summaries = co_await overview_.summaries();
  Json list = Json::array();
  for (const monitor::CellSummary& each : summaries) {
    const CellPtr at = cells_.find(each.name);
    if (!at || !may_see(session, *at)) continue;
    Json entry = monitor::summary_json(each);
    const bool knows_all = session.access() == Access::kControl;
    if (knows_all && !at->token().empty()) entry["token"] = at->token();
    list.push_back(std::move(entry));
  }
  session.send(monitor::result(request.id, {{"cells", std::move(list)}}));
}

/// Epoch and tick are those of the cell; null without one.
void MonitorService::describe(const CellPtr& at, MonitorSession& session,
                              const monitor::Request& request) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  Json value = at ? value_now(at->cell()) : Json{{"epoch", nullptr}, {"tick", nullptr}};
  value.update(monitor::description(std::get<monitor::Describe>(wanted.call).fn));
  session.send(monitor::result(request.id, value));
  if (at) at->acted();
}

}  // namespace xr3
