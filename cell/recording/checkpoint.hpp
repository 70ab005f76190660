// A cell's continuing state as a value, from which recorded inputs can be repeated bit-identically.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "cell/cell.hpp"

namespace xr3 {

struct Cell::Checkpoint {
  ModelPtr model;
  State state;
  Epoch epoch = 0;
  int model_rev = 1;
  SimClock clock = SimClock::manual();
  std::optional<ByteClock> byte_clock;
  std::optional<Transcript> transcript;
  Agenda agenda;
  std::map<LineId, SerialLine> lines;
  LineId last_line = 0;
  std::map<std::string, MachineSnapshotPtr> snapshots;
  DueBytes due_bytes;
  bool is_in_past = false;
  bool was_manual = false;
};

}  // namespace xr3
