#include "protocol/monitor/calls/form.hpp"

#include <algorithm>

namespace xr3::monitor {
namespace {

constexpr std::size_t kMaxMembers = 64;

bool is_crowded(JsonValue value) {
  if (!value.is_structured()) return false;
  if (value.is_object() && value.size() > kMaxMembers) return true;
  return std::any_of(value.begin(), value.end(), is_crowded);
}

}  // namespace

JsonValue document(ArgsReader& args, const std::string& name, Presence presence,
                   const std::string& allowed) {
  const JsonValue value = args.object(name, presence, allowed);
  if (!is_crowded(value)) return value;
  args.refuse(name, "objects of at most " + std::to_string(kMaxMembers) + " members");
  return {};
}

}  // namespace xr3::monitor
