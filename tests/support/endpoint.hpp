// Passes a byte through both halves of an endpoint, as a serial line does.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/line/rhino_endpoint.hpp"

namespace xr3::test {

inline void feed(RhinoEndpoint& endpoint, std::uint8_t byte, std::uint64_t offset,
                 Simulation& simulation, std::string& replies, std::vector<Exchange>& exchanges) {
  for (const Parsed& item : endpoint.parse(byte, offset, simulation.state().enabled))
    endpoint.execute(item, simulation, replies, exchanges);
}

}  // namespace xr3::test
