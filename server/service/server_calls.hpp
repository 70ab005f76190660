// The calls of monitor sessions on the server as a whole: `cells` and `describe`.
#pragma once

#include "server/cells/registry.hpp"
#include "server/net/asio.hpp"
#include "server/service/calls.hpp"
#include "server/service/overview.hpp"

namespace xr3 {

class ServerCalls {
 public:
  /// The references must outlive it.
  ServerCalls(CellRegistry& cells, Overview& overview) : cells_(cells), overview_(overview) {}

  // Each answers the call itself.
  asio::awaitable<void> carry_out(CallOf of, const monitor::ListCells&);
  /// Epoch and tick are those of the cell; null without one.
  static asio::awaitable<void> carry_out(CallOf of, const monitor::Describe& describe);

 private:
  Json exercise_json() const;

  CellRegistry& cells_;
  Overview& overview_;
};

}  // namespace xr3
