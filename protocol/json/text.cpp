#include "protocol/json/text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace xr3 {
namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kIndent = 2;

/// Appends the value on one line, or a beginning of it with which the line is longer than `most`.
void append(const Json& value, std::size_t most, std::string& line) {
  if (!value.is_structured()) {
    line += value.dump();
    return;
  }
  line += value.is_object() ? '{' : '[';
  const char* separator = "";
  for (const auto& [name, element] : value.items()) {
    line += std::exchange(separator, ", ");
    if (value.is_object()) line += Json(name).dump() + ": ";
    append(element, most, line);
    if (line.size() > most) return;
  }
  line += value.is_object() ? '}' : ']';
}

std::string on_one_line(const Json& value, std::size_t most = std::string::npos) {
  std::string line;
  append(value, most, line);
  return line;
}

/// A list of lists of scalars, such as points: several share a line.
bool is_list_of_rows(const Json& value) {
  const auto is_row = [](const Json& row) {
    return row.is_array() &&
           std::none_of(row.begin(), row.end(), [](const Json& v) { return v.is_structured(); });
  };
  return value.is_array() && std::all_of(value.begin(), value.end(), is_row);
}

std::string filled(const Json& rows, std::size_t indent) {
  std::string text;
  std::size_t column = kColumns;
  for (const Json& row : rows) {
    const std::string line = on_one_line(row);
    if (!text.empty()) text += ",";
    if (column + line.size() + 2 > kColumns) {
      text += "\n" + std::string(indent, ' ');
      column = indent;
    } else {
      text += " ";
    }
    text += line;
    column += line.size() + 2;
  }
  return text;
}

/// `used`: columns before the value on its line. `indent`: indentation of the value's contents.
std::string shown(const Json& value, std::size_t indent, std::size_t used) {
  std::string line = on_one_line(value, kColumns);
  const bool is_root = indent == kIndent;
  if (!value.is_structured() || value.empty() || (!is_root && used + line.size() < kColumns)) {
    return line;
  }
  std::string text;
  if (is_list_of_rows(value)) {
    text = filled(value, indent);
  } else {
    for (const auto& [name, element] : value.items()) {
      const std::string key = value.is_object() ? Json(name).dump() + ": " : "";
      if (!text.empty()) text += ",";
      text += "\n" + std::string(indent, ' ') + key;
      text += shown(element, indent + kIndent, indent + key.size());
    }
  }
  text += "\n" + std::string(indent - kIndent, ' ');
  return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace

std::string json_text(const Json& value) { return shown(value, kIndent, 0) + "\n"; }

}  // namespace xr3
