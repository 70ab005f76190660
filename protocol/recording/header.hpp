// The first line of a recording as a value: what a cell must be made of so that it continues in the
// same way, and the versions of what follows. Independent of files and the cell.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/faults/fault_state.hpp"
#include "core/model.hpp"
#include "core/sim_clock.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/json/codec.hpp"
#include "protocol/line/byte_clock_settings.hpp"
#include "protocol/line/line_speed.hpp"
#include "protocol/line/serial_settings.hpp"
#include "protocol/monitor/call.hpp"

namespace xr3::recording {

/// The version of the format of recordings.
inline constexpr int kFormat = 1;

/// A physical controller behind the simulator. Its bytes are in the recording.
struct RecordedDevice {
  std::string path;
  SerialSettings settings;
  bool is_mirrored = false;
};

/// The state of a cell that has gone on from the end of another recording. Its lines are closed.
struct ContinuedState {
  struct NamedState {
    std::string name;
    SavedCell saved{};
    bool operator==(const NamedState&) const = default;
  };

  std::string origin;  ///< digest of the files with which the first recording began
  Epoch epoch = 0;
  int us = 0;  ///< with a byte clock: microseconds after the tick, 0...999
  int model_rev = 1;
  LineId last_line = 0;
  std::optional<bool> past_was_manual{};    ///< in the past: whether the clock was manual before
  std::optional<bool> freeze_was_manual{};  ///< frozen: likewise
  SavedCell saved{};                        ///< the workcell is that of the model
  std::vector<NamedState> snapshots{};
};

struct Header {
  std::string program;   ///< name and version
  int state_format = 0;  ///< format of the digests, see cell/recording/state_hash.hpp
  std::string cell;      ///< name of the cell
  ModelPtr model;
  ClockMode mode = ClockMode::kReal;
  Rate rate;
  std::optional<ByteClockSettings> byte_clock;  ///< if the mode is, or was before a pause, kBytes
  std::optional<LineSpeed> line_speed;          ///< with a byte clock, only the time of a character
  std::optional<FaultPlan> faults;
  std::optional<RecordedDevice> device;
  std::optional<ContinuedState> start = {};  ///< nullopt for a fresh cell
};

Json header_to_json(const Header& header);

/// Reads what header_to_json() has made, beside a member `c`; errors go to the reading. Whether the
/// parts fit together is checked, too.
std::optional<Header> read_header(data::Reading& reading);

/// The version of the format that a first line claims; nullopt if it is no recording's.
std::optional<int> format_of(JsonValue line);

}  // namespace xr3::recording
