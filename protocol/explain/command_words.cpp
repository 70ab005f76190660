#include "protocol/explain/command_words.hpp"

#include <array>

#include "protocol/explain/diagnostic.hpp"

namespace xr3 {
namespace {

struct Namer {
  std::string_view operator()(const Move&) const { return "move"; }
  std::string_view operator()(const SetSpeed&) const { return "set_speed"; }
  std::string_view operator()(const Stop&) const { return "stop"; }
  std::string_view operator()(const QueryError&) const { return "query_error"; }
  std::string_view operator()(const QuerySignedError&) const { return "query_signed_error"; }
  std::string_view operator()(const QuerySwitch&) const { return "query_switch"; }
  std::string_view operator()(const QuerySwitchesI&) const { return "query_switches_i"; }
  std::string_view operator()(const QuerySwitchesJ&) const { return "query_switches_j"; }
  std::string_view operator()(const QueryInputs&) const { return "query_inputs"; }
  std::string_view operator()(const SetAuxiliary& set) const {
    if (set.port == 1) return set.on ? "auxiliary_1_on" : "auxiliary_1_off";
    return set.on ? "auxiliary_2_on" : "auxiliary_2_off";
  }
  std::string_view operator()(const SetOutput& set) const {
    return set.high ? "output_high" : "output_low";
  }
  std::string_view operator()(const ControllerReset&) const { return "controller_reset"; }
  std::string_view operator()(const ToggleDisplay&) const { return "toggle_display"; }
  std::string_view operator()(const SetViewVector&) const { return "set_view_vector"; }
  std::string_view operator()(const SoftHome&) const { return "soft_home"; }
  std::string_view operator()(const ToggleSimulator&) const { return "toggle_simulator"; }
  std::string_view operator()(const SetRefreshPeriod&) const { return "set_refresh_period"; }
  std::string_view operator()(const ToggleErasing&) const { return "toggle_erasing"; }
  std::string_view operator()(const SelectStatus&) const { return "select_status"; }
  std::string_view operator()(const ToggleFunctionKeys&) const { return "toggle_function_keys"; }
  std::string_view operator()(const CameraImage&) const { return "camera_image"; }
  std::string_view operator()(const CameraRow&) const { return "camera_row"; }
  std::string_view operator()(const CameraPixel&) const { return "camera_pixel"; }
};

constexpr std::array<std::string_view, 7> kStatusLines = {
    "blank",          "tool-configuration vector", "joint variables",
    "error counters", "encoder positions",         "switches",
    "tool opening"};

std::string number(int value) { return std::to_string(value); }

struct Describer {
  const wire::Executed& obeyed;

  std::string on_or_off() const { return obeyed.is_on ? "on" : "off"; }

  std::string operator()(const Move& move) const {
    const std::string words = std::string("move ") + move.label + " " + signed_number(move.counts);
    return obeyed.counter ? words + ", counter " + number(*obeyed.counter) : words;
  }
  std::string operator()(const SetSpeed& speed) const {
    return std::string("speed of ") + speed.label + ": " + number(speed.counts_per_s) +
           " counts a second";
  }
  std::string operator()(const Stop& stop) const {
    return std::string("stop ") + stop.label + ", counter 0";
  }
  std::string operator()(const QueryError& query) const {
    return std::string("asks how far ") + query.label + " has still to go";
  }
  std::string operator()(const QuerySignedError& query) const {
    return std::string("asks for the error counter of ") + query.label + " with its sign";
  }
  std::string operator()(const QuerySwitch& query) const {
    return std::string("asks for the microswitch of ") + query.label;
  }
  std::string operator()(const QuerySwitchesI&) const {
    return "asks for the microswitches of C...H";
  }
  std::string operator()(const QuerySwitchesJ&) const {
    return "asks for the microswitches of A and B and for input lines 5...8";
  }
  std::string operator()(const QueryInputs&) const { return "asks for input lines 1...4"; }
  std::string operator()(const SetAuxiliary& set) const {
    return "auxiliary port " + number(set.port) + (set.on ? " on" : " off");
  }
  std::string operator()(const SetOutput& set) const {
    return "output " + number(set.line) + (set.high ? " high" : " low");
  }
  std::string operator()(const ControllerReset&) const {
    return "controller reset: counters 0, outputs and ports off, speeds of the robot file; it "
           "does not send the robot home";
  }
  std::string operator()(const ToggleDisplay&) const { return "display " + on_or_off(); }
  std::string operator()(const SetViewVector& view) const {
    return "view along " + number(view.x) + "," + number(view.y) + "," + number(view.z);
  }
  std::string operator()(const SoftHome&) const {
    return "soft home: every joint at its home value, counters 0, no stall";
  }
  std::string operator()(const ToggleSimulator&) const {
    return obeyed.is_on ? "simulator enabled" : "simulator disabled: only A@ is obeyed from now on";
  }
  std::string operator()(const SetRefreshPeriod& period) const {
    const std::string half = period.half_seconds % 2 == 0 ? "" : ".5";
    return "display redrawn every " + number(period.half_seconds / 2) + half + " s";
  }
  std::string operator()(const ToggleErasing&) const {
    return obeyed.is_on ? "erasing on: earlier pictures are erased"
                        : "erasing off: the tool leaves its path";
  }
  std::string operator()(const SelectStatus& select) const {
    return "status line " + number(select.option) + ": " +
           std::string(kStatusLines.at(static_cast<std::size_t>(select.option)));
  }
  std::string operator()(const ToggleFunctionKeys&) const { return "function keys on or off"; }
  std::string operator()(const CameraImage&) const { return "asks for the camera's whole image"; }
  std::string operator()(const CameraRow& row) const {
    return "asks for row " + number(row.row) + " of the camera's image";
  }
  std::string operator()(const CameraPixel& pixel) const {
    return "asks for the pixel in column " + number(pixel.column) + ", row " + number(pixel.row);
  }
};

}  // namespace

std::string_view code_of(const Command& command) { return std::visit(Namer{}, command); }

std::string describe(const wire::Executed& obeyed) {
  return std::visit(Describer{obeyed}, obeyed.command);
}

}  // namespace xr3
