#include "protocol/data_json.hpp"

#include <cmath>
#include <numeric>
#include <sstream>

namespace xr3::data {
namespace {

constexpr std::size_t kLongestShown = 40;
constexpr double kLargestWholeDouble = 9007199254740992.0;

std::string plain(double number) {
  std::ostringstream out;
  out.precision(10);
  out << number;
  return out.str();
}

std::string range_words(const Range& range, std::string_view kind) {
  std::string words(kind);
  words += range.open_min ? " above " : " from ";
  words += plain(range.min) + (range.open_min ? ", up to " : " to ") + plain(range.max);
  if (!range.unit.empty()) words += " " + std::string(range.unit);
  return words;
}

bool is_within(const Range& range, double number) {
  return std::isfinite(number) && number <= range.max &&
         (range.open_min ? number > range.min : number >= range.min);
}

/// Levenshtein distance: how many letters to add, take away or change.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char letter : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t change = diagonal + (letter == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

Codec<double> scaled_number(Range range, std::string_view kind, bool is_length) {
  Codec<double> codec;
  codec.allowed = range_words(range, kind);
  codec.read = [range, is_length, allowed = codec.allowed](const Place& place, double& result) {
    if (!place.value.is_number()) return place.refuse(allowed);
    const double scale = is_length ? place.reading.mm_per_unit() : 1.0;
    const double number = place.value.get<double>() * scale;
    if (!is_within(range, number)) return place.refuse(allowed);
    return result = number, true;
  };
  codec.write = number_json;
  return codec;
}

const JsonSource& no_source() {
  static const JsonSource source(R"({"length_unit":"mm"})", "");
  return source;
}

}  // namespace

Reading::Reading(const JsonSource& source) : source_(source), findings_(source.duplicates()) {
  for (const Finding& duplicate : findings_) wrong_.insert(duplicate.pointer);
  const Json& root = source.root();
  if (!root.is_object()) return;
  const auto unit = root.find("length_unit");
  if (unit == root.end()) {
    report(Severity::kError, "/length_unit", "nothing", "\"mm\" or \"inch\"");
  } else if (*unit == "inch") {
    mm_per_unit_ = kMmPerInch;
  } else if (*unit != "mm") {
    report(Severity::kError, "/length_unit", shown(*unit), "\"mm\" or \"inch\"");
  }
}

Reading::Reading() : Reading(no_source()) {}

void Reading::report(Severity severity, const std::string& pointer, std::string found,
                     std::string allowed) {
  if (severity == Severity::kError) wrong_.insert(pointer);
  findings_.push_back({severity, source_.file(), source_.line_of(pointer), 0, pointer,
                       std::move(found), std::move(allowed)});
}

bool Reading::is_sound(const std::string& pointer) const {
  const std::string inside = pointer + "/";
  const auto first_inside = wrong_.lower_bound(inside);
  if (first_inside != wrong_.end() && first_inside->starts_with(inside)) return false;
  for (std::string around = pointer; !wrong_.contains(around);) {
    const std::size_t slash = around.rfind('/');
    if (slash == std::string::npos) return true;
    around.resize(slash);
  }
  return false;
}

Findings Reading::take_findings() {
  sort_by_line(findings_);
  return std::move(findings_);
}

Place Place::element(std::size_t index) const {
  return {reading, value[index], child_pointer(pointer, index)};
}

void Place::report(std::string found, std::string allowed) const {
  reading.report(Severity::kError, pointer, std::move(found), std::move(allowed));
}

bool Place::refuse(const std::string& allowed) const {
  report(shown(value), allowed);
  return false;
}

std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) {
    std::string whole = value.dump();
    if (whole.size() <= kLongestShown) return whole;
    return "a list of " + std::to_string(value.size());
  }
  if (value.is_number_float()) return number_json(value.get<double>()).dump();
  std::string words = value.dump();
  if (words.size() <= kLongestShown) return words;
  std::size_t end = kLongestShown;
  while (end > 0 && (words[end] & 0xC0) == 0x80) --end;  // not inside a letter of UTF-8
  return words.substr(0, end) + "...";
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& allowed) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, name.size() / 2);
  for (const std::string& candidate : allowed) {
    if (name.size() > 2 && candidate.starts_with(name)) return candidate;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < least || (distance == least && nearest.empty())) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

Json number_json(double number) {
  const bool is_whole = number == std::floor(number) && std::abs(number) < kLargestWholeDouble;
  if (is_whole) return static_cast<std::int64_t>(number);
  return number;
}

Codec<std::string> text(std::size_t min_length, std::size_t max_length) {
  Codec<std::string> codec;
  codec.allowed = "text of " + std::to_string(min_length) + " to " + std::to_string(max_length) +
                  " bytes in UTF-8";
  codec.read = [=, allowed = codec.allowed](const Place& place, std::string& result) {
    if (!place.value.is_string()) return place.refuse(allowed);
    const auto& found = place.value.get_ref<const std::string&>();
    if (found.size() < min_length || found.size() > max_length) return place.refuse(allowed);
    return result = found, true;
  };
  codec.write = [](const std::string& words) { return Json(words); };
  return codec;
}

Codec<bool> boolean() {
  Codec<bool> codec;
  codec.allowed = "true or false";
  codec.read = [](const Place& place, bool& result) {
    if (!place.value.is_boolean()) return place.refuse("true or false");
    return result = place.value.get<bool>(), true;
  };
  codec.write = [](const bool& value) { return Json(value); };
  return codec;
}

Codec<int> whole(int min, int max) { return integer<int>(min, max); }

Codec<double> number(Range range) { return scaled_number(range, "a number", false); }

Codec<double> length(Range range) {
  range.unit = "mm";
  return scaled_number(range, "a length", true);
}

namespace detail {

std::string quoted_names(const std::vector<std::string>& names) {
  std::string words;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) words += i + 1 == names.size() ? " or " : ", ";
    words += "\"" + names[i] + "\"";
  }
  return words;
}

std::string integer_words(std::int64_t min, std::int64_t max) {
  return "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
}

std::optional<std::int64_t> integer_in(const Json& value, std::int64_t min, std::int64_t max) {
  if (!value.is_number()) return std::nullopt;
  const auto number = value.get<double>();  // exact where it is in range
  const bool is_within = static_cast<double>(min) <= number && number <= static_cast<double>(max);
  if (!is_within || number != std::floor(number)) return std::nullopt;
  return static_cast<std::int64_t>(number);
}

std::string list_words(std::size_t min_count, std::size_t max_count) {
  if (min_count == max_count) return "a list of " + std::to_string(max_count);
  return "a list of " + std::to_string(min_count) + " to " + std::to_string(max_count);
}

void report_unknown(const Place& place, const std::vector<std::string>& names) {
  for (const auto& [name, value] : place.value.items()) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const std::string nearest = nearest_name(name, names);
    const std::string allowed =
        nearest.empty() ? quoted_names(names) : "perhaps \"" + nearest + "\" was meant";
    place.reading.report(Severity::kError, child_pointer(place.pointer, name),
                         "an unknown member \"" + name + "\"", allowed);
  }
}

}  // namespace detail
}  // namespace xr3::data
