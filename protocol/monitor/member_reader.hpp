// Reads members of a monitor message on a client's side. A member that is missing or has another
// type leaves its value unchanged: the server may be older or newer than this client.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "protocol/json/source.hpp"

namespace xr3::monitor {

/// The member, or JSON null if there is none or `object` is not an object.
const Json& member(const Json& object, const char* name);

void read(const Json& object, const char* name, std::string& into);
void read(const Json& object, const char* name, std::int64_t& into);
void read(const Json& object, const char* name, double& into);
void read(const Json& object, const char* name, bool& into);
void read(const Json& object, const char* name, std::array<double, 3>& into);
void read(const Json& object, const char* name, std::vector<bool>& into);

/// The member, or `otherwise`.
template <class Value>
Value value_of(const Json& object, const char* name, Value otherwise = {}) {
  read(object, name, otherwise);
  return otherwise;
}

}  // namespace xr3::monitor
