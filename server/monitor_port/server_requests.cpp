// Requests that concern all cells of the server: the channel `overview`, and the calls `cells` and
// `describe`.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/monitor/call_table.hpp"
#include "server/monitor_port/service.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxCellsAtOnce = 50;

/// A cell as the call `cells` shows it.
struct CellEntry {
  monitor::CellSummary summary;
  std::string token;  ///< empty: none, or not for this client
};

monitor::Message cells_message(const monitor::RequestId& id, const std::vector<CellEntry>& cells) {
  Json list = Json::array();
  for (const CellEntry& each : cells) {
    Json entry = monitor::summary_json(each.summary);
    if (!each.token.empty()) entry["token"] = each.token;
    list.push_back(std::move(entry));
  }
  return monitor::result(id, {{"cells", std::move(list)}});
}

}  // namespace

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
  std::vector<monitor::CellSummary> summaries = co_await overview_.summaries();
  std::vector<CellEntry> entries;
  for (monitor::CellSummary& each : summaries) {
    const CellPtr at = cells_.find(each.name);
    if (!at || !may_see(session, *at)) continue;
    const bool knows_all = session.access() == Access::kControl;
    entries.push_back({std::move(each), knows_all ? at->token() : ""});
  }
  const bool is_long = entries.size() > kMaxCellsAtOnce;
  Answer answer{
      [id = request.id, entries = std::move(entries)] { return cells_message(id, entries); },
      is_long};
  if (is_long) co_await making_long_.until_free();
  monitor::Message message = co_await message_of(std::move(answer));
  session.send(std::move(message));
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
