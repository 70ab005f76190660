// The monitor of one cell for one client, without a server: requests in, messages out. So a program
// that links the cell can show it on the page of the server. The client may do everything with the
// cell; what needs a server (other cells, ports, tokens) is refused.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "cell/frames.hpp"
#include "cell/history/history.hpp"
#include "protocol/monitor/client.hpp"

namespace xr3::service {

class CellMonitor {
 public:
  /// Greets the client. `product` is name and version of the program. `history`: nullptr if none is
  /// kept; it must outlive the monitor.
  CellMonitor(const std::string& product, std::shared_ptr<Cell> cell, const History* history);

  /// Carries out a request and queues its answer; an invalid one is answered by an error. No effect
  /// while the queue is full: see is_full().
  void handle(std::string_view message, WallNs now);
  /// Whether messages must be taken before the next request.
  bool is_full() const { return client_.is_full(); }

  /// Advances the cell to `now`, and offers the client the frames that are due.
  void offer_frames(WallNs now);

  /// The next message to the client; nullptr if there is none.
  monitor::Message next_output(WallNs now);

 private:
  struct Dispatch;

  std::shared_ptr<Cell> cell_;
  const History* history_;
  FrameCache frames_;
  monitor::Client client_;
  std::optional<LineId> line_;  ///< of the client's calls `send`
};

}  // namespace xr3::service
