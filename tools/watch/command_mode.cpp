#include "tools/watch/command_mode.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include "core/command.hpp"
#include "core/drawing/status_line.hpp"
#include "protocol/text/table.hpp"

namespace xr3::watch {
namespace {

constexpr char kEscape = '\x1B';
constexpr char kMenuKey = 'm';
constexpr std::size_t kMaxTyped = 16;
constexpr double kMsPerS = 1000;

/// A function of Table IV, or one of the screen's. `alt` is its function key; 0: none.
struct Function {
  std::string_view name;  ///< in the call `key`
  std::string_view title;
  int alt;
  char letter;
  std::string_view value;  ///< the values to type; empty if the function takes none
  std::size_t numbers;     ///< numbers in the value
  std::int64_t min;
  std::int64_t max;
};

constexpr std::array<Function, 8> kFunctions{{
    {"display", "graphics display", 1, 'd', "", 0, 0, 0},
    {"view", "view vector", 2, 'v', "x y z, each -9 to 9, not all 0", 3, -SetViewVector::kMax,
     SetViewVector::kMax},
    {"home", "soft home", 3, 'h', "", 0, 0, 0},
    {"status", "status line", 4, 's', "0 to 6", 1, 0, SelectStatus::kMax},
    {"enabled", "simulator", 5, 'e', "", 0, 0, 0},
    {"function_keys", "function keys", 6, 'k', "", 0, 0, 0},
    {"path", "erase before redrawing", 0, 'p', "", 0, 0, 0},
    {"period", "refresh period", 0, 'r', "1 to 255 half seconds", 1, SetRefreshPeriod::kMin,
     SetRefreshPeriod::kMax},
}};
constexpr int kAltOfFunctionKeys = 6;

/// The values typed for a function; empty if they are invalid for it.
std::vector<std::int64_t> read_value(const Function& function, std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream words(text);
  std::vector<std::int64_t> numbers;
  for (std::int64_t number = 0; words >> number;) {
    if (number < function.min || number > function.max) return {};
    numbers.push_back(number);
  }
  const bool are_zero = std::all_of(numbers.begin(), numbers.end(), [](auto n) { return n == 0; });
  const bool is_good = words.eof() && numbers.size() == function.numbers;
  return is_good && !(are_zero && function.numbers > 1) ? numbers : std::vector<std::int64_t>{};
}

std::string on_off(bool is_on) { return is_on ? "on" : "off"; }

std::string value_text(std::string_view name, const Display& display, bool is_enabled) {
  const auto& view = display.view;
  const auto option = static_cast<std::size_t>(display.status_option);
  if (name == "display") return on_off(display.is_on);
  if (name == "view") {
    return std::to_string(view[0]) + ", " + std::to_string(view[1]) + ", " +
           std::to_string(view[2]);
  }
  if (name == "status")
    return option < kStatusLines.size() ? std::string(kStatusLines[option]) : "";
  if (name == "enabled") return is_enabled ? "enabled" : "disabled";
  if (name == "function_keys") return on_off(display.has_function_keys);
  if (name == "path") return display.is_erasing ? "yes" : "no";
  if (name == "period")
    return plain_number(static_cast<double>(display.period_ticks) / kMsPerS) + " s";
  return "";
}

std::size_t index_of(const ModeKey& key, bool is_menu_open) {
  const bool is_function_key = key.function > 0 && (key.is_alt || is_menu_open);
  const auto* found = std::find_if(kFunctions.begin(), kFunctions.end(), [&](const auto& each) {
    return is_function_key ? each.alt == key.function
                           : !key.is_alt && key.letter != 0 && each.letter == key.letter;
  });
  return static_cast<std::size_t>(found - kFunctions.begin());
}

}  // namespace

CommandMode::KeyResult CommandMode::press(const ModeKey& key,
                                          const std::optional<Display>& display) {
  if (asked_) return press_in_prompt(key);
  const bool is_menu_key = key == ModeKey{kMenuKey, 0, false} || key == ModeKey{'-', 0, true};
  if (is_menu_key || (is_menu_open_ && key.letter == kEscape)) {
    is_menu_open_ = !is_menu_open_;
    return {true, {}};
  }
  const std::size_t function = index_of(key, is_menu_open_);
  if (function == kFunctions.size()) return {};
  const bool is_off = display && !display->has_function_keys;
  if (is_off && key.is_alt && key.function != kAltOfFunctionKeys) return {true, {}};
  const Function& wanted = kFunctions[function];
  if (wanted.numbers == 0) return {true, FunctionCall{std::string(wanted.name), {}}};
  asked_ = function;
  typed_.clear();
  is_wrong_ = false;
  return {true, {}};
}

CommandMode::KeyResult CommandMode::press_in_prompt(const ModeKey& key) {
  constexpr std::string_view kTyped = "0123456789- ,";
  constexpr std::string_view kRubout = "\b\x7F";
  const Function& wanted = kFunctions[*asked_];
  if (key.letter == kEscape) {
    asked_.reset();
  } else if (key.letter == '\n' || key.letter == '\r') {
    const std::vector<std::int64_t> value = read_value(wanted, typed_);
    is_wrong_ = value.empty();
    if (is_wrong_) return {true, {}};
    asked_.reset();
    return {true, FunctionCall{std::string(wanted.name), value}};
  } else if (key.letter != 0 && kRubout.find(key.letter) != std::string_view::npos) {
    if (!typed_.empty()) typed_.pop_back();
  } else if (key.letter != 0 && kTyped.find(key.letter) != std::string_view::npos) {
    if (typed_.size() < kMaxTyped) typed_ += key.letter;
  }
  return {true, {}};
}

std::string CommandMode::prompt() const {
  if (!asked_) return "";
  const Function& wanted = kFunctions[*asked_];
  return std::string(wanted.title) + " (" + std::string(wanted.value) + ")" +
         (is_wrong_ ? ", not this: " : ": ") + typed_ + "_   Enter sets it, Esc leaves it";
}

std::vector<std::string> menu_lines(const std::optional<Display>& display, bool is_enabled) {
  std::vector<std::vector<std::string>> rows{{"key", "", "function", "now"}};
  for (const Function& each : kFunctions) {
    const std::string alt = each.alt == 0 ? "" : "Alt F" + std::to_string(each.alt);
    rows.push_back({std::string(1, each.letter), alt, std::string(each.title),
                    display ? value_text(each.name, *display, is_enabled) : ""});
  }
  std::istringstream table(text_table(rows, "llll"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(table, line);) lines.push_back(line);
  lines.insert(lines.end(), {"", "m  Alt -  Esc   leave this menu"});
  return lines;
}

}  // namespace xr3::watch
