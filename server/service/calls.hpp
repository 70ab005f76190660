// The calls of monitor sessions on one cell, except those on its past. Each kind of call has a
// function, which is found by the type of the call.
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
#include "server/session/session.hpp"

namespace xr3 {

/// Epoch and tick, the first members of the value of each call.
Json value_now(const Cell& cell);

/// The answer with an error.
monitor::Message refused(const monitor::RequestId& id, const call::Refused& why);
/// The error of a request that names a line that is not open.
call::Refused no_such_line(LineId line);

/// A call with its cell and its session, which exist until it is answered.
struct CallOf {
  const CellPtr& at;  ///< nullptr is possible for calls on the server only
  MonitorSession& session;
  monitor::Request& request;
  const monitor::CallRequest& wanted;  ///< in the request

  const monitor::RequestId& id() const { return request.id; }
  Cell& cell() const { return at->cell(); }
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
  static Answer carry_out(CallOf of, const monitor::FindCounts& find);
  static Answer carry_out(CallOf of, const monitor::ListLines&);
  static Answer carry_out(CallOf of, const monitor::ListFaults&);
  static Answer carry_out(CallOf of, const monitor::DisconnectLine& disconnect);
  static Answer carry_out(CallOf of, const monitor::ReleasePeer&);
  static Answer carry_out(CallOf of, const monitor::ReadTranscript&);

 private:
  bool may_enlarge(const call::Call& call) const;
  static monitor::Message done(CallOf of, const call::Call& call, const call::Done& done);
  /// The session's own line of the cell, which a first `send` opens; nullopt if it has too many of
  /// other cells.
  std::optional<LineId> own_line(CallOf of);

  CellRegistry& cells_;
  MemoryLimit* memory_ = nullptr;  ///< none if null
};

}  // namespace xr3
