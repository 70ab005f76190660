#include "server/service/channels.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "server/net/wall_clock.hpp"
#include "service/channels.hpp"

namespace xr3 {
namespace {

using monitor::Channel;

service::WatchedCell watched(HostedCell& at) {
  at.cell().catch_up(wall_now());
  return {at.share(at.cell()), at.frames(), at.hub().now()};
}

}  // namespace

void MonitorChannels::carry_out(const CellPtr& at, MonitorSession& session,
                                const monitor::RequestId& id, const monitor::Subscribe& wanted) {
  if (wanted.selection.channel == Channel::kOverview) return follow_overview(session, id, wanted);
  if (!service::subscribe(watched(*at), session.client(), id, wanted)) return;
  at->hub().add(session);
  at->hub().changed();
  overview_.changed(*at);
}

void MonitorChannels::follow_overview(MonitorSession& session, const monitor::RequestId& id,
                                      const monitor::Subscribe& wanted) {
  const monitor::MilliHz rate = std::min(wanted.max_millihz, monitor::kMaxOverviewMilliHz);
  session.send(monitor::result(
      id, {{"channel", "overview"}, {"max_hz", static_cast<double>(rate) / 1000.0}}));
  session.client().follow_overview(rate);
  overview_.add(session);
}

void MonitorChannels::carry_out(const CellPtr& at, MonitorSession& session,
                                const monitor::RequestId& id, const monitor::Unsubscribe& wanted) {
  monitor::Client& client = session.client();
  if (wanted.channel == Channel::kOverview) {
    client.unfollow_overview();
    overview_.remove(session);
    session.send(monitor::result(id, Json::object()));
  } else {
    service::unsubscribe(at->name(), client, id, wanted);
    if (!client.follows(at->name())) at->hub().remove(session);
    overview_.changed(*at);
  }
}

asio::awaitable<void> MonitorChannels::carry_out(const CellPtr& at, MonitorSession& session,
                                                 const monitor::RequestId& id,
                                                 const monitor::Get& wanted) {
  if (wanted.selection.channel == Channel::kOverview) {
    const std::vector<monitor::CellSummary> cells = co_await overview_.summaries();
    session.send(monitor::with_id(overview_.whole(session, cells), id));
  } else {
    service::get(watched(*at), session.client(), id, wanted);
  }
}

}  // namespace xr3
