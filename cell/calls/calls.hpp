// The effect of each call on a cell, one file for a family of calls. A call that needs the manual
// clock is refused with `clock_running` if the clock is real.
#pragma once

#include "cell/output.hpp"
#include "cell/state.hpp"
#include "protocol/monitor/call.hpp"

namespace xr3 {

call::Outcome carry_out(CellState& cell, const call::Call& call, WallNs now, CellOutput& out);

// time.cpp
call::Outcome carry_out(CellState&, const call::Pause&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::Resume&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::Freeze&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::Unfreeze&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::SetRate&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::Step&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::RunUntil&, WallNs now, CellOutput&);
// machine.cpp
call::Outcome carry_out(CellState&, const call::Reset&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::Home&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::Key&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::SetInput&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::SayNotice&, WallNs now, CellOutput&);
// device.cpp
call::Outcome carry_out(CellState&, const call::StopDevice&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::AlignMirror&, WallNs now, CellOutput&);
// workcell.cpp
call::Outcome carry_out(CellState&, const call::AddBlock&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::MoveBlock&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::RemoveBlock&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::ReplaceWorkcell&, WallNs now, CellOutput&);
// snapshots.cpp
call::Outcome carry_out(CellState&, const call::SaveSnapshot&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::LoadSnapshot&, WallNs now, CellOutput&);
// faults.cpp
call::Outcome carry_out(CellState&, const call::SetFault&, WallNs now, CellOutput&);
call::Outcome carry_out(CellState&, const call::ClearFault&, WallNs now, CellOutput&);

/// Maximum number of named snapshots.
inline constexpr std::size_t kMaxSnapshots = 16;

}  // namespace xr3
