#include "tools/watch/read.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace xr3::watch {

namespace {

constexpr std::size_t kMaxLabelLength = 8;

Axis read_axis(const Json& object) {
  Axis axis;
  axis.label = value_of<std::string>(object, "label").substr(0, kMaxLabelLength);
  read(object, "count", axis.count);
  read(object, "error", axis.error);
  read(object, "value", axis.value);
  read(object, "unit", axis.unit);
  read(object, "speed", axis.speed);
  read(object, "switch", axis.is_closed);
  read(object, "moving", axis.is_moving);
  read(object, "blocked", axis.blocked);
  return axis;
}

WatchedTool read_tool(const Json& object) {
  WatchedTool tool;
  tool.axis = read_axis(object);
  read(object, "opening_mm", tool.opening_mm);
  read(object, "xyz_mm", tool.xyz_mm);
  read(object, "holding", tool.holding);
  return tool;
}

WatchedBlock read_block(const Json& object) {
  WatchedBlock block;
  read(object, "name", block.name);
  read(object, "xyz_mm", block.xyz_mm);
  read(object, "yaw_deg", block.yaw_deg);
  read(object, "held", block.is_held);
  return block;
}

LineEntry read_line(const Json& object) {
  LineEntry line;
  if (member(object, "line").is_number_integer())
    line.number = value_of<std::int64_t>(object, "line");
  read(object, "kind", line.kind);
  read(object, "peer", line.peer);
  if (member(object, "opened_tick").is_number_integer())
    line.opened = value_of<std::int64_t>(object, "opened_tick");
  read(object, "bytes_in", line.bytes_in);
  read(object, "bytes_out", line.bytes_out);
  read(object, "serial", line.settings);
  read(object, "last", line.last);
  if (member(object, "waits_for").is_number_integer())
    line.last = "waits for line " + std::to_string(value_of<std::int64_t>(object, "waits_for"));
  return line;
}

template <class Value>
std::vector<Value> read_each(const Json& object, const char* name, Value (*read_one)(const Json&)) {
  std::vector<Value> values;
  const Json& list = member(object, name);
  if (!list.is_array()) return values;
  std::transform(list.begin(), list.end(), std::back_inserter(values), read_one);
  return values;
}

/// The pixels of a row; empty if it does not have `width` pixels.
std::vector<bool> read_text_row(const Json& row, std::size_t width) {
  std::vector<bool> pixels;
  if (!row.is_string() || row.get_ref<const std::string&>().size() != width) return pixels;
  for (const char c : row.get_ref<const std::string&>()) pixels.push_back(c == '1');
  return pixels;
}

/// The pixels of a row of run lengths, which starts with a run of zeros; empty if it does not have
/// `width` pixels.
std::vector<bool> read_run_row(const Json& row, std::size_t width) {
  std::vector<bool> pixels;
  bool is_set = false;
  for (const Json& run : row) {
    if (!run.is_number_unsigned() || run.get<std::size_t>() > width - pixels.size()) return {};
    pixels.insert(pixels.end(), run.get<std::size_t>(), is_set);
    is_set = !is_set;
  }
  return pixels.size() == width ? pixels : std::vector<bool>{};
}

bool is_size(std::int64_t pixels) {
  return pixels > 0 && pixels <= static_cast<std::int64_t>(kMaxPixels);
}

}  // namespace

WatchedState read_state(const Json& message) {
  WatchedState state;
  state.joints = read_each<Axis>(message, "joints", read_axis);
  state.tool = read_tool(member(message, "tool"));
  state.blocks = read_each<WatchedBlock>(message, "blocks", read_block);
  const Json& io = member(message, "io");
  read(io, "inputs", state.inputs);
  read(io, "outputs", state.outputs);
  read(io, "aux", state.aux);
  read(message, "stalled", state.stalled);
  read(message, "enabled", state.is_enabled);
  const Json& device = member(message, "device");
  if (device.is_object())
    state.device = {value_of<std::string>(device, "path"), value_of<bool>(device, "open"),
                    value_of<bool>(device, "engaged")};
  return state;
}

std::vector<LineEntry> read_lines(const Json& value) {
  std::vector<LineEntry> lines = read_each<LineEntry>(value, "lines", read_line);
  const Json& device = member(value, "device");
  if (device.is_object()) lines.insert(lines.begin(), read_line(device));
  return lines;
}

Display read_display(const Json& message) {
  Display display;
  read(message, "on", display.is_on);
  const Json& view = member(message, "view");
  for (std::size_t i = 0; view.is_array() && i < std::min(view.size(), display.view.size()); ++i) {
    if (view[i].is_number_integer()) display.view[i] = view[i].get<std::int64_t>();
  }
  read(message, "erase", display.is_erasing);
  read(message, "period_ticks", display.period_ticks);
  read(message, "function_keys", display.has_function_keys);
  const Json& status = member(message, "status");
  read(status, "option", display.status_option);
  read(status, "text", display.status_text);
  return display;
}

void read_clock(const Json& clock, Known& known) {
  if (!clock.is_object()) return;
  const auto mode = value_of<std::string>(clock, "mode");
  known.mode = mode == "manual"  ? WatchedClockMode::kManual
               : mode == "bytes" ? WatchedClockMode::kBytes
                                 : WatchedClockMode::kReal;
  read(clock, "rate", known.rate);
}

void read_limits(const Json& drive, std::map<std::string, VariableRange>& limits) {
  const Json& range = member(drive, "limits");
  if (!range.is_array() || range.size() != 2) return;
  if (!range[0].is_number() || !range[1].is_number()) return;
  limits[value_of<std::string>(drive, "label").substr(0, kMaxLabelLength)] = {
      range[0].get<double>(), range[1].get<double>()};
}

std::optional<WatchedImage> read_image(const Json& message) {
  const auto width = value_of<std::int64_t>(message, "width");
  const auto height = value_of<std::int64_t>(message, "height");
  if (!is_size(width) || !is_size(height)) return {};
  WatchedImage image{static_cast<std::size_t>(width), static_cast<std::size_t>(height), {}};
  const bool is_text = value_of<std::string>(message, "encoding") == "rows";
  const Json& rows = member(message, "rows");
  if (!rows.is_array() || rows.size() != image.height) return {};
  for (const Json& row : rows) {
    const auto pixels = is_text ? read_text_row(row, image.width) : read_run_row(row, image.width);
    if (pixels.empty()) return {};
    image.pixels.insert(image.pixels.end(), pixels.begin(), pixels.end());
  }
  return image;
}

}  // namespace xr3::watch
