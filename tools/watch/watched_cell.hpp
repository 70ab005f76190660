// The data that `xr3 watch` shows, as plain values: everything received so far from the monitor
// port about one cell. Independent of JSON, sockets and the screen.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace xr3::watch {

/// Range of a joint's or the tool's variable, degrees or mm.
struct VariableRange {
  double min = 0;
  double max = 0;
};

/// A joint or the tool in the channel `state`.
struct Axis {
  std::string label;
  std::int64_t count = 0;  ///< encoder counts from the soft home
  std::int64_t error = 0;  ///< counts to go
  double value = 0;
  std::string unit;        ///< "deg" or "mm"
  std::int64_t speed = 0;  ///< counts per second
  bool is_closed = false;  ///< whether the microswitch is closed
  bool is_moving = false;
  std::string blocked;  ///< "limit", "block"; empty if not blocked
};

struct WatchedTool {
  Axis axis;
  double opening_mm = 0;
  std::array<double, 3> xyz_mm{};  ///< the tip
  std::string holding;             ///< name of the held block; empty if there is none
};

struct WatchedBlock {
  std::string name;
  std::array<double, 3> xyz_mm{};  ///< the centroid
  double yaw_deg = 0;
  bool is_held = false;
};

/// A physical controller behind the lines.
struct Device {
  std::string path;
  bool is_there = false;
  bool is_engaged = false;  ///< whether commands of the lines go to the controller
};

/// The channel `state`.
struct WatchedState {
  std::vector<Axis> joints;  ///< from the base
  WatchedTool tool;
  std::vector<WatchedBlock> blocks;
  std::vector<bool> inputs;  ///< index i is line i+1; the same for outputs and aux
  std::vector<bool> outputs;
  std::vector<bool> aux;
  std::string stalled;  ///< "protected_region", "work_surface"; empty if not stalled
  bool is_enabled = true;
  std::optional<Device> device;  ///< nullopt if the server has no --serial
};

/// A serial line, or the physical controller, in the result of the call `lines`.
struct LineEntry {
  std::optional<std::int64_t> number;  ///< nullopt if it is the physical controller
  std::string kind;
  std::string peer;  ///< the client's address, or the path of a device
  /// Tick of the opening; nullopt if the physical controller is not there.
  std::optional<std::int64_t> opened;
  std::int64_t bytes_in = 0;
  std::int64_t bytes_out = 0;
  std::string settings;  ///< settings of the serial port; empty if not known
  std::string last;      ///< the last command, or the line that this one waits for
};

/// The channel `display`: the settings of command mode, and the status line.
struct Display {
  bool is_on = false;
  std::array<std::int64_t, 3> view{};  ///< the view vector
  bool is_erasing = true;
  std::int64_t period_ticks = 0;
  bool has_function_keys = true;
  std::int64_t status_option = 0;
  std::string status_text;  ///< the text; may be empty
};

/// The channel `image`, row by row.
struct WatchedImage {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<bool> pixels;  ///< width * height elements

  bool at(std::size_t x, std::size_t y) const { return pixels[y * width + x]; }
};

struct ImageSize {
  std::size_t width = 0;
  std::size_t height = 0;
};

/// An event from the channel `event`.
struct Note {
  std::int64_t epoch = 0;
  std::int64_t tick = 0;
  std::string kind;  ///< "warning", "stalled", "homed"...
  std::string message;
  std::optional<std::int64_t> line;  ///< number of the serial line concerned
  std::int64_t times = 1;
};

enum class WatchedClockMode : std::uint8_t { kReal, kManual, kBytes };

/// All data received. `cell` is empty before the `hello` message, `state` before the first state.
struct Known {
  std::string server;  ///< name and version
  std::string cell;
  std::string robot;
  bool has_control = false;  ///< whether the server accepts this client's calls
  bool is_locked = false;    ///< whether the server shows nothing without the token
  std::int64_t epoch = 0;
  std::int64_t tick = 0;
  std::int64_t tick_hz = 1000;
  WatchedClockMode mode = WatchedClockMode::kReal;
  double rate = 1;
  std::map<std::string, VariableRange> limits;  ///< by label; empty before the model arrives
  std::optional<WatchedState> state;
  std::optional<Display> display;
  /// Nullopt if there is no camera, or no image was received yet.
  std::optional<WatchedImage> image;
  std::map<std::int64_t, Note> notes;  ///< the latest ones, by seq
  /// The lines, the physical controller first if there is one. nullopt before the first answer of
  /// `lines`.
  std::optional<std::vector<LineEntry>> lines;
  /// The server's last message for the user: an error or the text of `bye`.
  std::string last_message;
};

}  // namespace xr3::watch
