// Everything of one robot: model, state, clock, lines, epoch, and what its monitors can look back on.
// Inputs come in by apply() and nothing else changes a cell; it is brought up to date lazily, when an
// input or a look at it needs that. It knows no socket, so that a whole server can run in a test's
// memory. Wall time is an argument.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cell/counters.hpp"
#include "cell/input.hpp"
#include "cell/warning_limiter.hpp"
#include "core/sim_clock.hpp"
#include "core/simulation.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/explain/wire_record.hpp"
#include "protocol/monitor/feed.hpp"
#include "protocol/monitor/snapshot.hpp"

namespace xr3 {

using CellEventSink = std::function<void(const CellEvent&, const Model&)>;

class Cell {
 public:
  /// Every event goes into the ring, and to `sink`, which may be empty.
  Cell(std::string name, ModelPtr model, SimClock clock, CellEventSink sink);
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;

  const std::string& name() const { return name_; }
  const Model& model() const { return simulation_.model(); }
  const SimClock& clock() const { return clock_; }
  Epoch epoch() const { return epoch_; }
  /// Counts the workcells, and their changes from outside, from 1.
  int model_rev() const { return model_rev_; }
  /// Counts whatever can be seen of the cell: as long as it stays, every look shows the same.
  std::uint64_t revision() const { return revision_; }

  /// The one door. Time is brought up to `now` first; a call that needs standing time is refused by
  /// `clock_running` where time runs. Any exception is a VitalFailure: the input may be half done.
  Applied apply(const Input& input, WallNs now);

  /// Brings time up to `now` and tells what happened meanwhile. Throws as apply() does.
  void catch_up(WallNs now);

  /// Nothing changes the cell any more, and nothing is told: the process ends.
  void freeze() { is_frozen_ = true; }

  /// As of the last apply() or catch_up().
  const State& state() const { return simulation_.state(); }
  Snapshot snapshot() const;
  /// What the camera sees, made once for a state whoever asks; null where the workcell has no camera.
  ImagePtr camera_image() { return simulation_.camera_image(); }
  bool is_at_rest() const { return simulation_.is_at_rest(); }
  /// Time alone will tell something: a motor runs, or warnings were left out and nobody knows it yet.
  bool has_news_to_come() const {
    return clock_.mode() == ClockMode::kReal && (!is_at_rest() || warnings_.has_pending());
  }

  /// The last events, and the last bytes of the lines with what was made of them.
  monitor::Feed& events() { return events_; }
  monitor::Feed& wires() { return wires_; }
  static constexpr std::size_t kMaxEvents = 4096;
  static constexpr std::size_t kMaxWires = 1024;

  /// The line, or null: nothing of it but outbox and counters concerns a transport.
  SerialLine* find_line(LineId line);
  /// Without kProbeLine, of which nothing is counted, told or recorded.
  const std::map<LineId, SerialLine>& lines() const { return lines_; }

  /// How many bytes a line has received in all; also of one of the last kRememberedLines that closed.
  std::optional<std::uint64_t> bytes_in(LineId line) const;
  static constexpr std::size_t kRememberedLines = 1024;

  /// Named snapshots that can be kept.
  static constexpr std::size_t kMaxSnapshots = 16;

  const CellCounters& counters() const { return counters_; }

 private:
  Applied take_in(const Input& input, WallNs now);
  void advance(WallNs now);
  Applied handle(const LineOpened& opened, WallNs now);
  Applied handle(const BytesIn& in, WallNs now);
  Applied handle(const LineClosed& closed, WallNs now);
  Applied handle(const call::Call& call, WallNs now);

  call::Outcome carry_out(const call::Pause&, WallNs now);
  call::Outcome carry_out(const call::Resume&, WallNs now);
  call::Outcome carry_out(const call::SetRate& rate, WallNs now);
  call::Outcome carry_out(const call::Step& step, WallNs now);
  call::Outcome carry_out(const call::RunUntil& run, WallNs now);
  call::Outcome carry_out(const call::Reset&, WallNs now);
  call::Outcome carry_out(const call::Home&, WallNs now);
  call::Outcome carry_out(const call::Key& key, WallNs now);
  call::Outcome carry_out(const call::SetInput& input, WallNs now);
  call::Outcome carry_out(const call::AddBlock& add, WallNs now);
  call::Outcome carry_out(const call::MoveBlock& move, WallNs now);
  call::Outcome carry_out(const call::RemoveBlock& remove, WallNs now);
  call::Outcome carry_out(const call::ReplaceWorkcell& replace, WallNs now);
  call::Outcome carry_out(const call::SaveSnapshot& save, WallNs now);
  call::Outcome carry_out(const call::LoadSnapshot& load, WallNs now);

  void begin_epoch(std::string_view call, WallNs now, const std::function<void()>& change);
  void after_manual_advance(Tick start, WallNs now);
  void changed_model(std::string_view call, const std::string& name);
  ModelPtr model_with(const Workcell& workcell) const;

  Applied take_unseen(SerialLine& line, std::string_view bytes);
  std::size_t receive_piece(LineId id, SerialLine& line, std::string_view bytes);
  void emit(std::optional<LineId> line, CellNote note);
  void emit_machine_events(std::optional<LineId> line, Events events);
  void emit_time_events();
  void emit_at(Tick tick, std::optional<LineId> line, CellNote note);
  void emit_exchanges(LineId id, SerialLine& line);
  void emit_all(LineId line, std::vector<CellNote> notes);
  void warn(LineId line, const Parsed& parsed, std::string_view code,
            const std::function<std::string()>& message);

  std::string name_;
  Simulation simulation_;
  SimClock clock_;
  Epoch epoch_ = 0;
  int model_rev_ = 1;
  std::uint64_t revision_ = 1;
  std::map<LineId, SerialLine> lines_;
  LineId last_line_ = 0;
  std::optional<SerialLine> probe_line_;
  std::map<LineId, std::uint64_t> closed_bytes_in_;  ///< of lines that are gone, the oldest first
  std::map<std::string, SavedCellPtr> snapshots_;
  std::vector<Exchange> exchanges_;  ///< of the bytes being taken; kept for its memory
  WarningLimiter warnings_;
  struct StampedEvent {
    CellEvent event;
    ModelPtr model;  ///< as it was then
  };
  monitor::Ring<StampedEvent> events_;
  monitor::Ring<WireRecord> wires_;
  CellCounters counters_;
  CellEventSink sink_;
  bool is_frozen_ = false;
};

}  // namespace xr3
