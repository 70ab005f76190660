// Everything of one robot: model, state, clock, lines and epoch. Inputs come in by apply() and nothing
// else changes a cell; it is brought up to date lazily, when an input or a look at it needs that.
// It knows no socket, so that a whole server can run in a test's memory. Wall time is an argument.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/sim_clock.hpp"
#include "core/simulation.hpp"
#include "server/cell_event.hpp"
#include "server/input.hpp"
#include "server/warning_gate.hpp"

namespace xr3 {

class Cell {
 public:
  Cell(std::string name, ModelPtr model, SimClock clock, CellEventSink sink);

  const std::string& name() const { return name_; }
  const Model& model() const { return simulation_.model(); }
  const SimClock& clock() const { return clock_; }
  Epoch epoch() const { return epoch_; }

  /// The one door. Time is brought up to `now` first; a call that needs standing time is refused by
  /// `clock_running` where time runs.
  Applied apply(const Input& input, WallNs now);

  /// Brings time up to `now` and tells what happened meanwhile.
  void catch_up(WallNs now);

  /// As of the last apply() or catch_up().
  const State& state() const { return simulation_.state(); }
  bool is_at_rest() const { return simulation_.is_at_rest(); }

  /// The line, or null: nothing of it but outbox and counters concerns a transport.
  Line* find_line(LineId line);
  std::size_t line_count() const { return lines_.size(); }

  /// How many bytes a line has received in all; also of one of the last kRememberedLines that closed.
  std::optional<std::uint64_t> bytes_in(LineId line) const;
  static constexpr std::size_t kRememberedLines = 1024;

 private:
  Applied take(const LineOpened& opened, WallNs now);
  Applied take(const BytesIn& in, WallNs now);
  Applied take(const LineClosed& closed, WallNs now);
  Applied take(const call::Call& call, WallNs now);

  call::Outcome carry_out(const call::Pause&, WallNs now);
  call::Outcome carry_out(const call::Resume&, WallNs now);
  call::Outcome carry_out(const call::SetRate& rate, WallNs now);
  call::Outcome carry_out(const call::Step& step, WallNs now);
  call::Outcome carry_out(const call::RunUntil& run, WallNs now);
  call::Outcome carry_out(const call::Reset&, WallNs now);
  call::Outcome carry_out(const call::Home&, WallNs now);

  void tell(std::optional<LineId> line, CellNote note);
  void tell_machine(std::optional<LineId> line, Events events);
  void tell_exchanges(LineId line);
  void tell_all(LineId line, std::vector<CellNote> notes);
  void warn(LineId line, const Parsed& parsed, std::string_view code,
            const std::function<std::string()>& message);

  std::string name_;
  Simulation simulation_;
  SimClock clock_;
  Epoch epoch_ = 0;
  std::map<LineId, Line> lines_;
  std::map<LineId, std::uint64_t> closed_bytes_in_;  ///< of lines that are gone, the oldest first
  std::vector<Exchange> exchanges_;  ///< of the bytes being taken; kept for its memory
  WarningGate warnings_;
  CellEventSink sink_;
};

}  // namespace xr3
