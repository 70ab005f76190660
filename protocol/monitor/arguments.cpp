#include "protocol/monitor/arguments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/json/source.hpp"
#include "protocol/monitor/fields.hpp"
#include "protocol/monitor/request_error.hpp"

namespace xr3::monitor {
namespace {

constexpr std::size_t kMaxFoundLength = 200;
constexpr std::array<std::string_view, 5> kAlwaysSent = {"op", "cell", "epoch", "seq", "tick"};

/// The value itself if the finding describes it as such; otherwise the finding's description.
Json found_by(const data::Reading::Kept& kept) {
  if (!kept.value) return nullptr;
  return data::shown(kept.value) == kept.finding.found ? shown(kept.value)
                                                       : Json(kept.finding.found);
}

std::string whole_range(std::int64_t low, std::int64_t high) {
  return "a whole number " + std::to_string(low) + "..." + std::to_string(high);
}

}  // namespace

Json shown(JsonValue value) {
  if (value.json_size(kMaxFoundLength) <= kMaxFoundLength)
    return Json(nlohmann::json(value.to_json()));  // sorts members
  const char* kind = value.is_text() ? "string" : value.is_list() ? "array" : "object";
  const std::size_t size = value.is_text() ? value.text_size() : value.json_size();
  return std::string(kind) + " of " + std::to_string(size) + " bytes";
}

void InvalidValues::keep(const std::string& pointer, Json found, std::string allowed) {
  details_.push_back({cut(pointer, kMaxFoundLength), std::move(found), std::move(allowed)});
}

void InvalidValues::add(const std::string& pointer, JsonValue found, std::string allowed) {
  if (counts()) keep(pointer, found ? shown(found) : Json(), std::move(allowed));
}

void InvalidValues::add_errors(const data::Reading& reading, const std::string& at) {
  for (const data::Reading::Kept& kept : reading.kept()) {
    if (counts()) keep(at + kept.finding.pointer, found_by(kept), kept.finding.allowed);
  }
  count_ += reading.errors() - reading.kept().size();
}

RequestError InvalidValues::error(RequestId id) const {
  std::string message = std::to_string(count_) + (count_ == 1 ? " wrong field" : " wrong fields");
  if (count_ > details_.size()) message += ", the first of them in details";
  return {std::move(id), "bad_args", std::move(message), "nothing was changed", details_};
}

std::optional<std::int64_t> whole_number(JsonValue value) {
  if (!value.is_number()) return std::nullopt;
  const double number = value.number();  // exact for integers in the range
  if (std::trunc(number) != number || std::abs(number) > static_cast<double>(kMaxInteger))
    return std::nullopt;
  return static_cast<std::int64_t>(number);
}

JsonValue ArgsReader::ask(const std::string& name, Presence presence, std::string allowed) {
  const bool is_known = std::any_of(asked_.begin(), asked_.end(),
                                    [&name](const Asked& each) { return each.name == name; });
  if (!is_known) asked_.push_back({name, presence == Presence::kRequired, std::move(allowed)});
  return object_.find(name);
}

JsonValue ArgsReader::object(const std::string& name, Presence presence,
                             const std::string& allowed) {
  const JsonValue value = ask(name, presence, allowed);
  const bool is_good = value ? value.is_object() : presence == Presence::kOptional;
  if (is_good) return value;
  refuse(name, allowed);
  return {};
}

std::optional<std::int64_t> ArgsReader::integer(const std::string& name, std::int64_t low,
                                                std::int64_t high, Presence presence) {
  const JsonValue value = ask(name, presence, whole_range(low, high));
  if (!value && presence == Presence::kOptional) return std::nullopt;
  const auto number = whole_number(value);
  if (number && low <= *number && *number <= high) return number;
  refuse(name, whole_range(low, high));
  return std::nullopt;
}

std::optional<double> ArgsReader::number(const std::string& name, double low, double high,
                                         Presence presence) {
  const std::string allowed = "a number " + Json(low).dump() + "..." + Json(high).dump();
  const JsonValue value = ask(name, presence, allowed);
  if (!value && presence == Presence::kOptional) return std::nullopt;
  const double number = value.is_number() ? value.number() : low - 1;
  if (low <= number && number <= high) return number;
  refuse(name, allowed);
  return std::nullopt;
}

Fields ArgsReader::fields(const std::string& name, Channel channel) {
  const std::vector<std::string>& members = members_of(channel);
  const std::string allowed =
      "a list of members of " + std::string(name_of(channel)) + ": " + data::quoted_names(members);
  const JsonValue value = ask(name, Presence::kOptional, allowed);
  if (!value) return std::nullopt;
  if (!value.is_list()) {
    refuse(name, allowed);
    return std::nullopt;
  }
  std::vector<std::string> names;
  for (const JsonValue element : value) {
    if (!element.is_one_of(kAlwaysSent) && !element.is_one_of(members)) {
      if (findings_.counts())
        findings_.keep(pointer_ + element.pointer_from(object_), shown(element),
                       data::quoted_names(members));
      continue;
    }
    std::string field = element.text();
    if (std::find(names.begin(), names.end(), field) == names.end())
      names.push_back(std::move(field));
  }
  return names;
}

bool ArgsReader::has_one_of(const std::string& first, const std::string& second) {
  if (static_cast<bool>(object_.find(first)) != static_cast<bool>(object_.find(second)))
    return true;
  refuse(first, "one of \"" + first + "\" and \"" + second + "\"");
  return false;
}

std::string ArgsReader::pointer_to(const std::string& name) const {
  return child_pointer(pointer_, name);
}

void ArgsReader::refuse(const std::string& name, std::string allowed) {
  findings_.add(pointer_to(name), object_.find(name), std::move(allowed));
}

void ArgsReader::refuse_others() {
  if (!object_) return;
  std::vector<std::string> known;
  for (const Asked& each : asked_) known.push_back(each.name);
  std::sort(known.begin(), known.end());
  const std::string allowed = known.empty() ? "no members" : "only " + data::quoted_names(known);
  for (const JsonValue value : object_) {
    if (!value.name().is_one_of(known) && findings_.counts())
      findings_.keep(pointer_ + value.pointer_from(object_), shown(value), allowed);
  }
}

}  // namespace xr3::monitor
