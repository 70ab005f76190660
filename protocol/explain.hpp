// The last byte explained: what the controller made of the bytes of a serial line, and what its replies
// mean, in plain words. A pure function of a record; nothing here is needed to drive a robot.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/model.hpp"
#include "protocol/wire_record.hpp"

namespace xr3 {

/// One line of an explanation: what the bytes [from, to) of the line's stream were. `code` is stable.
struct Explanation {
  std::uint64_t from = 0;
  std::uint64_t to = 0;
  std::string_view code;
  std::string message;
};

/// Everything that was made of a record's bytes, in the order in which it was completed. `model` gives
/// labels, units and the camera's size.
std::vector<Explanation> explain(const WireRecord& record, const Model& model);

}  // namespace xr3
