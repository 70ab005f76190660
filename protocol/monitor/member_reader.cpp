#include "protocol/monitor/member_reader.hpp"

#include <nlohmann/json.hpp>

namespace xr3::monitor {

const Json& member(const Json& object, const char* name) {
  static const Json none;
  const auto found = object.find(name);
  return object.is_object() && found != object.end() ? *found : none;
}

void read(const Json& object, const char* name, std::string& into) {
  const Json& value = member(object, name);
  if (value.is_string()) into = value.get<std::string>();
}
void read(const Json& object, const char* name, std::int64_t& into) {
  const Json& value = member(object, name);
  if (value.is_number_integer()) into = value.get<std::int64_t>();
}
void read(const Json& object, const char* name, double& into) {
  const Json& value = member(object, name);
  if (value.is_number()) into = value.get<double>();
}
void read(const Json& object, const char* name, bool& into) {
  const Json& value = member(object, name);
  if (value.is_boolean()) into = value.get<bool>();
}
void read(const Json& object, const char* name, std::array<double, 3>& into) {
  const Json& value = member(object, name);
  if (!value.is_array() || value.size() != into.size()) return;
  for (std::size_t i = 0; i < into.size(); ++i) {
    if (value[i].is_number()) into[i] = value[i].get<double>();
  }
}
void read(const Json& object, const char* name, std::vector<bool>& into) {
  const Json& value = member(object, name);
  if (!value.is_array()) return;
  for (const Json& bit : value) into.push_back(bit.is_boolean() && bit.get<bool>());
}

}  // namespace xr3::monitor
