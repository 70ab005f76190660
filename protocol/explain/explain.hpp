// Explains the bytes of a serial line: how the controller interpreted them and what its replies
// mean. A pure function of a record; for display only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/model.hpp"
#include "protocol/explain/wire_record.hpp"

namespace xr3 {

/// One line of an explanation: the meaning of the bytes [from, to) of the line's stream. `code` is
/// stable.
struct Explanation {
  std::uint64_t from = 0;
  std::uint64_t to = 0;
  std::string_view code;
  std::string message;
};

/// The explanations of a record's bytes, in order of completion. `model` gives labels, units and
/// the camera's size.
std::vector<Explanation> explain(const WireRecord& record, const Model& model);

}  // namespace xr3
