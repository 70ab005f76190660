// What a terminal view shows, as plain values: everything that a monitor port has told so far about
// one cell. It knows no JSON, no socket and no screen.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace xr3::watch {

/// A joint's or the tool's variable may go from `min` to `max`, degrees or mm.
struct Limits {
  double min = 0;
  double max = 0;
};

/// A joint or the tool, as the channel `state` tells it.
struct Axis {
  std::string label;
  std::int64_t count = 0;  ///< encoder counts from the soft home
  std::int64_t error = 0;  ///< counts to go
  double value = 0;
  std::string unit;        ///< "deg" or "mm"
  std::int64_t speed = 0;  ///< counts a second
  bool is_closed = false;  ///< its microswitch
  bool is_moving = false;
  std::string blocked;  ///< "limit", "block"; empty: nothing is in the way
};

struct Tool {
  Axis axis;
  double opening_mm = 0;
  std::array<double, 3> xyz_mm{};  ///< of the tip
  std::string holding;             ///< name of a block; empty: none
};

struct Block {
  std::string name;
  std::array<double, 3> xyz_mm{};  ///< of its centroid
  double yaw_deg = 0;
  bool is_held = false;
};

/// The channel `state`.
struct State {
  std::vector<Axis> joints;  ///< from the base on
  Tool tool;
  std::vector<Block> blocks;
  std::vector<bool> inputs;  ///< index i is line i+1, as in the next two
  std::vector<bool> outputs;
  std::vector<bool> aux;
  std::string stalled;  ///< "protected_region", "work_surface"; empty: it is not
  bool is_enabled = true;
};

/// The channel `image`, row by row.
struct Image {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<bool> pixels;  ///< width * height of them

  bool at(std::size_t x, std::size_t y) const { return pixels[y * width + x]; }
};

struct ImageSize {
  std::size_t width = 0;
  std::size_t height = 0;
};

/// Something that happened, from the channel `event`.
struct Note {
  std::int64_t epoch = 0;
  std::int64_t tick = 0;
  std::string kind;  ///< "warning", "stalled", "homed"...
  std::string message;
  std::optional<std::int64_t> line;  ///< the serial line that it is about
  std::int64_t times = 1;
};

enum class ClockMode : std::uint8_t { kReal, kManual };

/// All that is known. Before the greeting `cell` is empty, before a state there is none.
struct Known {
  std::string server;  ///< name and version
  std::string cell;
  std::string robot;
  bool has_control = false;  ///< calls are carried out for us
  std::int64_t epoch = 0;
  std::int64_t tick = 0;
  std::int64_t tick_hz = 1000;
  ClockMode mode = ClockMode::kReal;
  double rate = 1;
  std::map<std::string, Limits> limits;  ///< by label; empty until the model came
  std::optional<State> state;
  std::optional<Image> image;          ///< none: no camera, or nothing came yet
  std::map<std::int64_t, Note> notes;  ///< the last ones, by their seq
  std::string said;  ///< the last word of the server to us: a refusal, its farewell
};

}  // namespace xr3::watch
