// The calls of the monitor on one cell. Each kind has a function, which is found by the type of the
// call, applies it to the cell, and gives the answer. Without sockets, threads and clocks.
//
// The flow through the folder: protocol/monitor has read a request, and it comes here with its cell
// and the wall time. calls.hpp has the calls, in calls.cpp, inverse.cpp and lines.cpp; lines.hpp
// sends bytes on a client's own line. channels.hpp carries out `sub`, `unsub` and `get` for a
// client, and frames.hpp offers it the frames that are due. past.hpp makes times of a cell's past,
// in whatever thread. answer.hpp has what many answers share.
// The server decides when a function runs, and for whom; cell_monitor.hpp does so for one cell and
// one client, without a server.
#pragma once

#include "cell/cell.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3::service {

/// A call at its cell, and the wall time. The references must outlive it.
struct CellCall {
  Cell& cell;
  monitor::Request& request;
  const monitor::CallRequest& wanted;  ///< in the request
  WallNs now;

  const monitor::RequestId& id() const { return request.id; }
};

monitor::Message carry_out(const CellCall& of, const call::Call& call);
monitor::Message carry_out(const CellCall& of, const monitor::FindCounts& find);
monitor::Message carry_out(const CellCall& of, const monitor::ListLines&);
monitor::Message carry_out(const CellCall& of, const monitor::ListFaults&);
monitor::Message carry_out(const CellCall& of, const monitor::ReadTranscript&);

}  // namespace xr3::service
