// The calls of monitor sessions on one cell, except those on its past: what they wait for, and what
// they need of the server. Their effects and answers are in service/.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "cell/cell.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request_error.hpp"
#include "server/cells/registry.hpp"
#include "server/net/asio.hpp"
#include "server/net/memory_limit.hpp"
#include "server/net/wall_clock.hpp"
#include "server/session/session.hpp"
#include "service/calls.hpp"

namespace xr3 {

/// A call with its cell and its session, which exist until it is answered.
struct CallOf {
  const CellPtr& at;  ///< nullptr is possible for calls on the server only
  MonitorSession& session;
  monitor::Request& request;
  const monitor::CallRequest& wanted;  ///< in the request

  const monitor::RequestId& id() const { return request.id; }
  Cell& cell() const { return at->cell(); }
  /// The call at the present.
  service::CellCall now() const { return {cell(), request, wanted, wall_now()}; }
};

class MonitorCalls {
 public:
  using Answer = asio::awaitable<monitor::Message>;

  /// The registry must outlive it.
  explicit MonitorCalls(CellRegistry& cells) : cells_(cells) {}

  /// Refuses calls that enlarge one of several cells, beyond a limit of memory, which must outlive
  /// this object.
  void limit_memory(MemoryLimit& limit) { memory_ = &limit; }

  /// Beyond this number a session gets no further line of its own.
  static constexpr std::size_t kMaxOwnLines = 64;

  /// Waits for the bytes that a call needs before it can be carried out: those of its member
  /// `after`, and those that have arrived before a call that moves time. Returns the error, or
  /// nullopt.
  static asio::awaitable<std::optional<call::Refused>> wait(CallOf of);

  Answer carry_out(CallOf of, const call::Call& call);
  Answer carry_out(CallOf of, const monitor::Send& send);
  static Answer carry_out(CallOf of, const monitor::DisconnectLine& disconnect);
  static Answer carry_out(CallOf of, const monitor::ReleasePeer&);
  template <class OtherCall>
  static Answer carry_out(CallOf of, const OtherCall& call) {
    co_return service::carry_out(of.now(), call);
  }

 private:
  bool may_enlarge(const call::Call& call) const;
  /// The session's own line of the cell, which a first `send` opens; nullopt if it has too many of
  /// other cells.
  std::optional<LineId> own_line(CallOf of);

  CellRegistry& cells_;
  MemoryLimit* memory_ = nullptr;  ///< none if null
};

}  // namespace xr3
