#include "protocol/monitor_args.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "protocol/json_source.hpp"
#include "protocol/monitor_fields.hpp"

namespace xr3::monitor {
namespace {

constexpr std::size_t kLongestFound = 200;
constexpr std::array<std::string_view, 5> kAlwaysSent = {"op", "cell", "epoch", "seq", "tick"};

/// The value as it stands, or, for one that is long, what it is: a text by its own bytes, a list or an
/// object by those of its JSON.
Json shown(const Tree& value) {
  const std::string json = value.dump(-1, ' ', false, Tree::error_handler_t::replace);
  if (json.size() <= kLongestFound) return Json::parse(json);
  const std::size_t size =
      value.is_string() ? value.get_ref<const std::string&>().size() : json.size();
  return std::string(value.type_name()) + " of " + std::to_string(size) + " bytes";
}

/// What stands at a pointer inside the value, or null.
const Tree* value_at(const Tree& value, const std::string& pointer) {
  const Tree::json_pointer path(pointer);
  return value.contains(path) ? &value.at(path) : nullptr;
}

/// What a finding found, as JSON where it is just the value that stands there.
Json found_by(const Finding& finding, const Tree* value) {
  if (value == nullptr) return nullptr;
  return data::shown(Json(*value)) == finding.found ? shown(*value) : Json(finding.found);
}

std::string whole_range(std::int64_t low, std::int64_t high) {
  return "a whole number " + std::to_string(low) + "..." + std::to_string(high);
}

bool is_member(const Tree& value, const std::vector<std::string>& members) {
  if (!value.is_string()) return false;
  const auto& name = value.get_ref<const std::string&>();
  return std::find(kAlwaysSent.begin(), kAlwaysSent.end(), name) != kAlwaysSent.end() ||
         std::find(members.begin(), members.end(), name) != members.end();
}

}  // namespace

void Findings::keep(std::string pointer, Json found, std::string allowed) {
  if (pointer.size() > kLongestFound) pointer = pointer.substr(0, kLongestFound) + "...";
  details_.push_back({std::move(pointer), std::move(found), std::move(allowed)});
}

void Findings::add(std::string pointer, const Tree* found, std::string allowed) {
  if (count_++ >= kMostDetails) return;
  keep(std::move(pointer), found == nullptr ? Json() : shown(*found), std::move(allowed));
}

void Findings::add_errors(const xr3::Findings& errors, const Tree& value, const std::string& at) {
  for (const Finding& error : errors) {
    if (error.severity != Severity::kError || count_++ >= kMostDetails) continue;
    const Tree* found = value_at(value, error.pointer.substr(at.size()));
    keep(error.pointer, found_by(error, found), error.allowed);
  }
}

RequestError Findings::error(RequestId id) const {
  std::string message = std::to_string(count_) + (count_ == 1 ? " wrong field" : " wrong fields");
  if (count_ > details_.size()) message += ", the first of them in details";
  return {std::move(id), "bad_args", std::move(message), "nothing was changed", details_};
}

std::optional<std::int64_t> whole_number(const Tree& value) {
  if (!value.is_number()) return std::nullopt;
  if (value.is_number_integer() && !value.is_number_unsigned()) {  // below 0
    const auto number = value.get<std::int64_t>();
    return number >= -kMostInteger ? std::optional(number) : std::nullopt;
  }
  const auto number = value.get<double>();  // those that matter are exact in a double
  if (std::trunc(number) != number || std::abs(number) > static_cast<double>(kMostInteger))
    return std::nullopt;
  return static_cast<std::int64_t>(number);
}

const Tree* ArgsReader::find(const std::string& name) const {
  if (object_ == nullptr) return nullptr;
  const auto found = object_->find(name);
  return found == object_->end() ? nullptr : &*found;
}

const Tree* ArgsReader::ask(const std::string& name, Presence presence, std::string allowed) {
  const bool is_known = std::any_of(asked_.begin(), asked_.end(),
                                    [&name](const Asked& each) { return each.name == name; });
  if (!is_known) asked_.push_back({name, presence == Presence::kRequired, std::move(allowed)});
  return find(name);
}

const Tree* ArgsReader::object(const std::string& name, Presence presence,
                               const std::string& allowed) {
  const Tree* value = ask(name, presence, allowed);
  const bool is_good = value == nullptr ? presence == Presence::kOptional : value->is_object();
  if (is_good) return value;
  refuse(name, allowed);
  return nullptr;
}

std::optional<std::int64_t> ArgsReader::whole(const std::string& name, std::int64_t low,
                                              std::int64_t high, Presence presence) {
  const Tree* value = ask(name, presence, whole_range(low, high));
  if (value == nullptr && presence == Presence::kOptional) return std::nullopt;
  const auto number = value == nullptr ? std::nullopt : whole_number(*value);
  if (number && low <= *number && *number <= high) return number;
  refuse(name, whole_range(low, high));
  return std::nullopt;
}

std::optional<double> ArgsReader::number(const std::string& name, double low, double high,
                                         Presence presence) {
  const std::string allowed = "a number " + Json(low).dump() + "..." + Json(high).dump();
  const Tree* value = ask(name, presence, allowed);
  if (value == nullptr && presence == Presence::kOptional) return std::nullopt;
  const double number = value != nullptr && value->is_number() ? value->get<double>() : low - 1;
  if (low <= number && number <= high) return number;
  refuse(name, allowed);
  return std::nullopt;
}

Fields ArgsReader::fields(const std::string& name, Channel channel) {
  const std::vector<std::string>& members = members_of(channel);
  const std::string allowed =
      "a list of members of " + std::string(name_of(channel)) + ": " + one_of(members);
  const Tree* value = ask(name, Presence::kOptional, allowed);
  if (value == nullptr) return std::nullopt;
  if (!value->is_array()) {
    refuse(name, allowed);
    return std::nullopt;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < value->size(); ++i) {
    const Tree& element = (*value)[i];
    if (!is_member(element, members)) {
      findings_.add(child_pointer(pointer_to(name), i), &element, one_of(members));
      continue;
    }
    const auto& field = element.get_ref<const std::string&>();
    if (std::find(names.begin(), names.end(), field) == names.end()) names.push_back(field);
  }
  return names;
}

bool ArgsReader::has_one_of(const std::string& first, const std::string& second) {
  if ((find(first) == nullptr) != (find(second) == nullptr)) return true;
  refuse(first, "one of \"" + first + "\" and \"" + second + "\"");
  return false;
}

std::string ArgsReader::pointer_to(const std::string& name) const {
  return child_pointer(pointer_, name);
}

void ArgsReader::refuse(const std::string& name, std::string allowed) {
  findings_.add(pointer_to(name), find(name), std::move(allowed));
}

void ArgsReader::refuse_others() {
  if (object_ == nullptr) return;
  std::vector<std::string> known;
  for (const Asked& each : asked_) known.push_back(each.name);
  std::sort(known.begin(), known.end());
  const std::string allowed = known.empty() ? "no members" : "only " + one_of(known);
  for (const auto& [name, value] : object_->items()) {
    const bool is_known = std::binary_search(known.begin(), known.end(), name);
    if (!is_known) findings_.add(pointer_to(name), &value, allowed);
  }
}

}  // namespace xr3::monitor
