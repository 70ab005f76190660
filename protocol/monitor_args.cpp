#include "protocol/monitor_args.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "protocol/json_source.hpp"

namespace xr3::monitor {
namespace {

constexpr std::size_t kLongestFound = 200;
constexpr std::array<std::string_view, 5> kAlwaysSent = {"op", "cell", "epoch", "seq", "tick"};

/// The value as it stands, or, for one that is long, what it is.
Json shown(const Tree& value) {
  const std::string text = value.dump(-1, ' ', false, Tree::error_handler_t::replace);
  if (text.size() <= kLongestFound) return Json::parse(text);
  return std::string(value.type_name()) + " of " + std::to_string(text.size()) + " bytes";
}

std::string whole_range(std::int64_t low, std::int64_t high) {
  return "a whole number " + std::to_string(low) + "..." + std::to_string(high);
}

bool is_state_member(const Tree& value) {
  if (!value.is_string()) return false;
  const auto& name = value.get_ref<const std::string&>();
  return std::find(kAlwaysSent.begin(), kAlwaysSent.end(), name) != kAlwaysSent.end() ||
         std::find(state_members().begin(), state_members().end(), name) != state_members().end();
}

}  // namespace

void Findings::add(std::string pointer, const Tree* found, std::string allowed) {
  if (count_++ >= kMostDetails) return;
  if (pointer.size() > kLongestFound) pointer = pointer.substr(0, kLongestFound) + "...";
  details_.push_back(
      {std::move(pointer), found == nullptr ? Json() : shown(*found), std::move(allowed)});
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

const Tree* ArgsReader::find(const std::string& name) {
  known_.push_back(name);
  if (object_ == nullptr) return nullptr;
  const auto found = object_->find(name);
  return found == object_->end() ? nullptr : &*found;
}

std::int64_t ArgsReader::whole(const std::string& name, std::int64_t low, std::int64_t high) {
  const Tree* value = find(name);
  const auto number = value == nullptr ? std::nullopt : whole_number(*value);
  if (number && low <= *number && *number <= high) return *number;
  findings_.add(pointer_to(name), value, whole_range(low, high));
  return low;
}

std::int64_t ArgsReader::whole_or(const std::string& name, std::int64_t low, std::int64_t high,
                                  std::int64_t otherwise) {
  return find(name) == nullptr ? otherwise : whole(name, low, high);
}

double ArgsReader::number(const std::string& name, double low, double high) {
  const Tree* value = find(name);
  const double number = value != nullptr && value->is_number() ? value->get<double>() : low - 1;
  if (low <= number && number <= high) return number;
  findings_.add(pointer_to(name), value,
                "a number " + Json(low).dump() + "..." + Json(high).dump());
  return low;
}

Fields ArgsReader::fields(const std::string& name) {
  const Tree* value = find(name);
  if (value == nullptr) return std::nullopt;
  if (!value->is_array()) {
    findings_.add(pointer_to(name), value,
                  "a list of members of state: " + one_of(state_members()));
    return std::nullopt;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < value->size(); ++i) {
    const Tree& element = (*value)[i];
    if (!is_state_member(element)) {
      findings_.add(child_pointer(pointer_to(name), i), &element, one_of(state_members()));
      continue;
    }
    const auto& field = element.get_ref<const std::string&>();
    if (std::find(names.begin(), names.end(), field) == names.end()) names.push_back(field);
  }
  return names;
}

const Tree* ArgsReader::object(const std::string& name) {
  const Tree* value = find(name);
  if (value == nullptr || value->is_object()) return value;
  findings_.add(pointer_to(name), value, "an object");
  return nullptr;
}

std::string ArgsReader::pointer_to(const std::string& name) const {
  return child_pointer(pointer_, name);
}

void ArgsReader::refuse(const std::string& name, std::string allowed) {
  findings_.add(pointer_to(name), find(name), std::move(allowed));
}

void ArgsReader::refuse_others() {
  if (object_ == nullptr) return;
  std::sort(known_.begin(), known_.end());
  known_.erase(std::unique(known_.begin(), known_.end()), known_.end());
  const std::string allowed = known_.empty() ? "no members" : "only " + one_of(known_);
  for (const auto& [name, value] : object_->items()) {
    const bool known = std::binary_search(known_.begin(), known_.end(), name);
    if (!known) findings_.add(pointer_to(name), &value, allowed);
  }
}

}  // namespace xr3::monitor
