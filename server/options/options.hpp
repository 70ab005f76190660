// The options of `xr3 serve` as values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cell/byte_clock.hpp"
#include "core/model.hpp"
#include "core/sim_clock.hpp"
#include "protocol/line/line_guard.hpp"
#include "protocol/line/line_speed.hpp"
#include "protocol/line/serial_settings.hpp"
#include "server/base/option_sources.hpp"
#include "server/options/cells.hpp"
#include "server/options/token.hpp"

namespace xr3 {

/// The initial clock: real, at a rate, or manual, advanced only by the monitor, or that of the
/// bytes.
struct ClockChoice {
  ClockMode mode = ClockMode::kReal;
  Rate rate;
  ByteClockSettings bytes;  ///< has_concurrent_lines is an option of its own
  bool operator==(const ClockChoice&) const = default;
};

/// The serial port of a physical controller.
struct DeviceChoice {
  std::string path;
  SerialSettings settings;
};

struct ServeOptions {
  std::string robot = "rhino-xr3";    ///< name or path
  std::string workcell;               ///< name or path; empty: the one with the robot's name
  std::string listen = "localhost";   ///< localhost: 127.0.0.1 and, with IPv6, ::1
  std::uint16_t robot_port = 9600;    ///< 0: any free port
  std::uint16_t monitor_port = 9601;  ///< 0: any free port
  std::size_t cells = 0;              ///< 0: one, with the name main
  std::vector<CellChoice> cell_choices;
  bool is_cell_per_connection = false;
  std::size_t max_cells = 1000;
  double linger_s = 60;  ///< how long a cell or the owner of its port is kept after its last line
  bool binds_peer = false;
  Profile profile = Profile::kPaper;
  ClockChoice clock;
  bool has_concurrent_lines = false;  ///< with the byte clock: all lines are obeyed together
  std::size_t max_lines = 64;
  Guard guard = Guard::kNormal;
  std::string fault_file;               ///< name or path; empty: none
  std::optional<LineSpeed> line_speed;  ///< nullopt: bytes take no time
  std::optional<DeviceChoice> device;
  bool is_mirrored = false;         ///< the simulation imitates the device
  std::vector<std::string> ptys;    ///< paths of pseudo-terminals
  std::uint32_t pty_mode = 0600;    ///< rights of their slaves
  std::size_t max_per_address = 0;  ///< 0: the default
  std::size_t max_memory_mib = 512;
  std::string port_file;  ///< empty: none
  std::string record;     ///< the file of the recording; empty: none
  std::size_t record_max_mib = 1024;
  std::size_t record_total_mib = 8192;
  Tick history_ticks = 3600 * kTickHz;  ///< how long the past is kept; 0: not at all
  std::string log_level = "info";
  std::string log_file;  ///< empty: standard error
  TokenSource token;
  bool is_private = false;
  std::string metrics_token_file;  ///< empty: none
  std::vector<std::string> allow_hosts;
  std::vector<std::string> allow_origins;
  bool is_insecure = false;
  std::string config;  ///< a config file; empty: none
  OptionSources option_sources;
};

/// Whether there are, or may be, several cells.
inline bool has_many_cells(const ServeOptions& options) {
  return options.cells > 0 || !options.cell_choices.empty() || options.is_cell_per_connection;
}

/// 127.0.0.0/8, ::1 or localhost: reachable from this machine only.
bool is_loopback(const std::string& address);

}  // namespace xr3
