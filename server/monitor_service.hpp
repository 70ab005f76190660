// What the monitor's clients ask of the cell, carried out: requests in, messages out. It knows no
// connection; all of them, whatever they are made of, share one service.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocol/monitor_message.hpp"
#include "protocol/monitor_request.hpp"
#include "server/asio.hpp"
#include "server/cell.hpp"
#include "server/robot_port.hpp"

namespace xr3 {

/// Numbers the states that clients are shown: the same state has the same number for all of them.
class StateSequence {
 public:
  std::int64_t number_of(const Snapshot& snapshot);

 private:
  std::optional<Snapshot> last_;
  std::int64_t seq_ = 0;
};

class MonitorService {
 public:
  /// `acted` is called after each call.
  MonitorService(Cell& cell, RobotPort& robot_port, std::function<void()> acted)
      : cell_(cell), robot_port_(robot_port), acted_(std::move(acted)) {}

  std::vector<std::string> cells() const { return {cell_.name()}; }

  /// The first message of a connection.
  monitor::Message hello();

  /// Carries out a request and answers it. A call with `after` waits; nothing else does.
  asio::awaitable<monitor::Message> answer(monitor::Request request);

 private:
  monitor::Message show_state(const monitor::Request& request, const monitor::Get& get);
  asio::awaitable<std::optional<monitor::RequestError>> wait_for(monitor::After after);
  monitor::Message carry_out(monitor::Request& request);
  monitor::Message done(const monitor::Request& request, const call::Done& done);
  Snapshot snapshot() const;

  Cell& cell_;
  RobotPort& robot_port_;
  std::function<void()> acted_;
  StateSequence sequence_;
};

}  // namespace xr3
