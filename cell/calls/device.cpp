#include "cell/device.hpp"

#include "cell/calls/calls.hpp"
#include "cell/events.hpp"

namespace xr3 {

call::Outcome carry_out(CellState& cell, const call::StopDevice&, WallNs, CellOutput& out) {
  if (!cell.device)
    return call::Refused{"no_device", "no device is connected",
                         "start the server with --serial DEVICE"};
  if (!cell.device->is_open())
    return call::Refused{"no_device", "device " + cell.device->path() + " is not there",
                         "stop the arm by its own switch"};
  cell.device->stop(cell.tick());
  if (cell.mirror && cell.device->is_engaged()) {
    for (const char label : cell.model().labels()) cell.machine.execute(Stop{label});
  }
  emit_device(cell, DeviceNews::kStopped, {}, out);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::AlignMirror&, WallNs, CellOutput& out) {
  if (!cell.mirror)
    return call::Refused{"no_device", "there is no mirrored device",
                         "start the server with --serial DEVICE --mirror"};
  cell.machine.execute(SoftHome{});
  cell.mirror->align();
  emit_time_events(cell, out);
  emit_device(cell, DeviceNews::kMirrorAligned, {}, out);
  return call::Done{};
}

}  // namespace xr3
