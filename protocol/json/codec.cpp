#include "protocol/json/codec.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "protocol/text/table.hpp"

namespace xr3::data {
namespace {

constexpr std::size_t kMaxShownLength = 40;
constexpr double kLargestWholeDouble = 9007199254740992.0;

std::string range_text(const Range& range, std::string_view kind) {
  std::string text(kind);
  text += range.open_min ? " above " : " from ";
  text += significant_digits(range.min, 10) + (range.open_min ? ", up to " : " to ") +
          significant_digits(range.max, 10);
  if (!range.unit.empty()) text += " " + std::string(range.unit);
  return text;
}

bool is_within(const Range& range, double number) {
  return std::isfinite(number) && number <= range.max &&
         (range.open_min ? number > range.min : number >= range.min);
}

/// Levenshtein distance: the number of insertions, deletions and substitutions.
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
  codec.allowed = range_text(range, kind);
  codec.read = [range, is_length, allowed = codec.allowed](const Place& place, double& result) {
    if (!place.value.is_number()) return place.refuse(allowed);
    const double scale = is_length ? place.reading.mm_per_unit() : 1.0;
    const double number = place.value.number() * scale;
    if (!is_within(range, number)) return place.refuse(allowed);
    return result = number, true;
  };
  codec.write = number_json;
  return codec;
}

}  // namespace

Reading::Reading(const JsonSource& source, Unit unit)
    : source_(&source), root_(source.root()), most_(kMaxFindings) {
  source.document().for_each_duplicate([this](JsonValue member) {
    if (keeps_error()) keep(member, describe_duplicate(member), "each member once");
  });
  if (unit == Unit::kOfDocument) take_unit();
}

Reading::Reading(JsonValue root, Unit unit) : root_(root), most_(kMaxOfValue) {
  if (unit == Unit::kOfDocument) take_unit();
}

void Reading::take_unit() {
  if (!root_.is_object()) return;
  const JsonValue unit = root_.find("length_unit");
  if (unit.is("inch")) {
    mm_per_unit_ = kMmPerInch;
  } else if (!unit.is("mm")) {
    report(Severity::kError, "/length_unit", unit ? shown(unit) : "", "\"mm\" or \"inch\"");
  }
}

bool Reading::keeps(Severity severity) {
  if (severity == Severity::kWarning && !wants_warnings()) return false;
  ++(severity == Severity::kError ? errors_ : warnings_);
  return !is_full();
}

void Reading::keep(Severity severity, std::string pointer, JsonValue value, JsonValue line,
                   std::string found, std::string allowed) {
  pointer = cut(pointer, kMaxPointerLength);
  if (severity == Severity::kError) wrong_.insert(pointer);
  findings_.push_back(
      {{severity, source_ ? source_->file() : "", source_ ? source_->line_of(line) : 1, 0,
        std::move(pointer), std::move(found), std::move(allowed)},
       value});
}

void Reading::report(Severity severity, const std::string& pointer, std::string found,
                     std::string allowed) {
  if (!keeps(severity)) return;
  keep(severity, pointer, root_.at(pointer), root_.nearest(pointer), std::move(found),
       std::move(allowed));
}

void Reading::keep(JsonValue value, std::string found, std::string allowed) {
  keep(Severity::kError, value.pointer_from(root_), value, value, std::move(found),
       std::move(allowed));
}

void Reading::keep_missing(JsonValue object, const std::string& member, std::string allowed) {
  keep(Severity::kError, child_pointer(object.pointer_from(root_), member), {}, object, "",
       std::move(allowed));
}

void Reading::adopt(const Reading& part) {
  for (const Kept& each : part.findings_) {
    if (!keeps(each.finding.severity)) continue;
    keep(each.finding.severity, part.root_.pointer_from(root_) + each.finding.pointer, each.value,
         part.root_, each.finding.found, each.finding.allowed);
  }
  errors_ += part.errors_ + part.warnings_ - part.findings_.size();
}

bool Reading::is_sound(const std::string& pointer) const {
  if (wrong_.empty()) return true;
  if (is_full()) return false;
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

void Reading::refuse_part(const std::string& pointer, const Findings& findings) {
  for (const Finding& each : findings)
    if (each.severity == Severity::kError) refuse(pointer + each.pointer, each.found, each.allowed);
}

Findings Reading::take_findings() {
  Findings findings;
  for (Kept& each : findings_) findings.push_back(std::move(each.finding));
  sort_by_line(findings);
  const std::size_t more = errors_ + warnings_ - findings_.size();
  if (more > 0) {
    Finding rest;
    rest.severity = errors_ > 0 ? Severity::kError : Severity::kWarning;
    rest.file = findings.back().file;
    rest.line = findings.back().line;
    rest.more = more;
    findings.push_back(std::move(rest));
  }
  return findings;
}

bool Place::refuse(const std::string& allowed) const {
  if (reading.keeps_error()) reading.keep(value, shown(value), allowed);
  return false;
}

std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) {
    std::string text = value.dump();
    if (text.size() <= kMaxShownLength) return text;
    return "a list of " + std::to_string(value.size());
  }
  if (value.is_number_float()) return number_json(value.get<double>()).dump();
  const std::string text = value.dump();
  return cut(text, kMaxShownLength);
}

std::string shown(JsonValue value) {
  if (value.is_object()) return "an object";
  if (value.is_text()) return shown(Json(value.text(kMaxShownLength)));
  if (value.is_list() && value.json_size(kMaxShownLength) > kMaxShownLength)
    return "a list of " + std::to_string(value.size());
  return shown(value.to_json());
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& allowed) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, name.size() / 2);
  for (const std::string& candidate : allowed) {
    if (name.size() > 2 && candidate.starts_with(name)) return candidate;
    const std::size_t longer = std::max(name.size(), candidate.size());
    if (longer - std::min(name.size(), candidate.size()) > least)
      continue;  // the distance is at least this difference
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < least || (distance == least && nearest.empty())) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string quoted_names(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += "\"" + names[i] + "\"";
  }
  return text;
}

Json number_json(double number) {
  const bool is_whole = number == std::floor(number) && std::abs(number) < kLargestWholeDouble;
  if (is_whole) return static_cast<std::int64_t>(number);
  return number;
}

Codec<std::string> text(std::size_t min_length, std::size_t max_length) {
  const auto parse = [=](JsonValue value) -> std::optional<std::string> {
    const std::size_t size = value.is_text() ? value.text_size() : max_length + 1;
    if (size < min_length || size > max_length) return std::nullopt;
    return value.text();
  };
  return parsed<std::string>("text of " + std::to_string(min_length) + " to " +
                                 std::to_string(max_length) + " bytes in UTF-8",
                             parse);
}

Codec<bool> boolean() {
  return parsed<bool>("true or false", [](JsonValue value) {
    return value.is_boolean() ? std::optional(value.is_true()) : std::nullopt;
  });
}

Codec<int> whole_number(int min, int max) { return integer<int>(min, max); }

Codec<double> number(Range range) { return scaled_number(range, "a number", false); }

Codec<double> length(Range range) {
  range.unit = "mm";
  return scaled_number(range, "a length", true);
}

namespace detail {

std::string integer_text(std::int64_t min, std::int64_t max) {
  return "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
}

std::optional<std::int64_t> integer_in(JsonValue value, std::int64_t min, std::int64_t max) {
  if (!value.is_number()) return std::nullopt;
  const double number = value.number();  // exact if in range
  const bool is_within = static_cast<double>(min) <= number && number <= static_cast<double>(max);
  if (!is_within || number != std::floor(number)) return std::nullopt;
  return static_cast<std::int64_t>(number);
}

std::string list_text(std::size_t min_count, std::size_t max_count) {
  if (min_count == max_count) return "a list of " + std::to_string(max_count);
  return "a list of " + std::to_string(min_count) + " to " + std::to_string(max_count);
}

void keep_unknown(const Place& member, const std::vector<std::string>& names) {
  const std::string name = member.value.name().text(Reading::kMaxNameLength + 1);
  const std::string nearest = nearest_name(name, names);
  member.reading.keep(
      member.value, "an unknown member \"" + cut(name, Reading::kMaxNameLength) + "\"",
      nearest.empty() ? quoted_names(names) : "perhaps \"" + nearest + "\" was meant");
}

}  // namespace detail
}  // namespace xr3::data
