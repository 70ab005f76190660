#include "protocol/json/text.hpp"

#include <algorithm>

namespace xr3 {
namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kIndent = 2;

std::string on_one_line(const Json& value) {
  if (!value.is_structured()) return value.dump();
  std::string line;
  for (const auto& [name, element] : value.items()) {
    if (!line.empty()) line += ", ";
    if (value.is_object()) line += Json(name).dump() + ": ";
    line += on_one_line(element);
  }
  return value.is_object() ? "{" + line + "}" : "[" + line + "]";
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
  std::string line = on_one_line(value);
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
