// How the parts of a cell report: events, warnings within their limit, and records of lines.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/output.hpp"
#include "cell/state.hpp"

namespace xr3 {

void emit(CellState& cell, std::optional<LineId> line, CellNote note, CellOutput& out);
void emit_all(CellState& cell, LineId line, std::vector<CellNote> notes, CellOutput& out);

/// Emits the events of the machine.
void emit_machine_events(CellState& cell, Events events, CellOutput& out);
/// Emits the events of the machine since the last call, and the reports of suppressed warnings and
/// of inquiries without an answer that are due.
void emit_time_events(CellState& cell, CellOutput& out);

/// Emits a problem of a line, unless it extends a run of the same. Calls `message` only for the
/// first problem of a run: invalid bytes can arrive by the megabyte.
void warn(CellState& cell, SerialLine& line, const Parsed& parsed, std::string_view code,
          const std::function<std::string()>& message, CellOutput& out);
/// Emits the exchanges of the line that is being served, as far as they are not reported.
void emit_exchanges(CellState& cell, SerialLine& line, CellOutput& out);
/// Emits the events of faults on the line, if there are any.
void emit_fault_events(CellState& cell, SerialLine& line, CellOutput& out);

/// The outbox of a line before something is added.
struct OutputMark {
  std::uint64_t end = 0;   ///< offset of the next byte of the output
  std::size_t unsent = 0;  ///< bytes in the outbox
};
OutputMark mark_output(const SerialLine& line);
/// Records the bytes that the line has added to its outbox since then.
void record_output(CellState& cell, const SerialLine& line, const OutputMark& before,
                   CellOutput& out);

}  // namespace xr3
