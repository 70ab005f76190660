// The requests `sub`, `unsub` and `get`, on the channels of a cell and on the overview of all
// cells.
#pragma once

#include "server/cells/hosted_cell.hpp"
#include "server/net/asio.hpp"
#include "server/service/overview.hpp"
#include "server/session/session.hpp"

namespace xr3 {

class MonitorChannels {
 public:
  /// The reference must outlive it.
  explicit MonitorChannels(Overview& overview) : overview_(overview) {}

  // Each answers the request itself. Only those on the overview allow that `at` is null.
  void carry_out(const CellPtr& at, MonitorSession& session, const monitor::RequestId& id,
                 const monitor::Subscribe& wanted);
  void carry_out(const CellPtr& at, MonitorSession& session, const monitor::RequestId& id,
                 const monitor::Unsubscribe& wanted);
  asio::awaitable<void> carry_out(const CellPtr& at, MonitorSession& session,
                                  const monitor::RequestId& id, const monitor::Get& wanted);

 private:
  void follow_overview(MonitorSession& session, const monitor::RequestId& id,
                       const monitor::Subscribe& wanted);

  Overview& overview_;
};

}  // namespace xr3
