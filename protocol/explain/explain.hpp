// Explains the bytes of a serial line: how the controller interpreted them and what its replies
// mean. A pure function of a record; for display only.
//
// The flow through the folder: each read and each write of a line fills a WireRecord
// (wire_record.hpp), a compact value without text, because a line may carry thousands of commands
// per second. Only for a subscriber explain() converts it to sentences with byte offsets.
// command_text.hpp has the texts of commands and replies, diagnostic.hpp those of bytes that were
// not executed and of warnings, fault_text.hpp those of faults on demand. reply_decoder.hpp is the
// client's direction: it computes the reply that received bytes are, for `xr3 term` and for the
// replies of a physical controller. Events of the machine and of its lines (cell_event.hpp) take
// another path: event_report.hpp turns each into kind, code, sentence and members, for the log and
// for the monitor's channel `event`.
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
