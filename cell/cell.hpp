// One robot: its state, the rings of its latest events and line records, and its observers. Only
// apply() and the passing of time change a cell. Time advances lazily, in apply() and catch_up().
// No sockets, so that a test can run a whole server in memory. Wall time is an argument.
//
// The flow through the folder: a cell is a value (state.hpp), and each way into it is one, too
// (input.hpp). apply.hpp has a case for each input. Bytes of a line go through receive.hpp to the
// command that they complete, and its reply through reply.hpp to the outbox; line/ has the stages
// on their way. calls/ has the effect of each call. advance.hpp lets time pass, and with a byte
// clock byte_time.hpp does. The results, such as events and replies, are collected (output.hpp,
// events.hpp) and handed to the observers (observer.hpp), then to the rings: recording/ records and
// replays, history/ keeps the past, judge/ collects facts. Only cell.hpp knows observers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cell/advance.hpp"
#include "cell/apply.hpp"
#include "cell/byte_time.hpp"
#include "cell/epoch.hpp"
#include "cell/observer.hpp"
#include "cell/receive.hpp"
#include "cell/state.hpp"
#include "protocol/monitor/feed.hpp"
#include "protocol/monitor/snapshot.hpp"

namespace xr3 {

class Cell final {
 public:
  /// `budget` limits the memory of the rings and must outlive the cell; nullptr for no limit.
  Cell(std::string name, ModelPtr model, SimClock clock, monitor::ByteBudget* budget = nullptr);
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;

  // --- Settings. Precondition of each: no line is open.

  /// From now on, commands of the lines go to a physical controller while the simulator is
  /// disabled. Preconditions: the clock is real at rate 1, bytes take no time, and there was no
  /// device. `is_mirrored`: the simulation carries the commands out, too, and is compared with the
  /// device.
  void connect_device(std::string path, const SerialSettings& settings, bool is_mirrored = false);
  /// Sets the faults with which the cell starts, and to which a reset returns. Precondition: the
  /// robot has the joints.
  void set_faults(FaultPlan plan);
  /// From now on, the byte clock has these rules; see byte_clock.hpp. `speed` only sets the time of
  /// a character. Preconditions: the clock was made by SimClock::bytes(), and the lines have no
  /// speed.
  void set_byte_clock(const ByteClockSettings& settings,
                      const std::optional<LineSpeed>& speed = {});
  /// From now on, the bytes of lines take time, except on those of the monitor. Precondition: there
  /// is no device.
  void set_line_speed(const LineSpeed& speed);
  /// Continues a cell of another process from its end: sets its state, the faults of its start,
  /// the speed of its lines, and its ContinuedState::origin. Preconditions: this cell is fresh,
  /// both have the same robot and profile, and neither has a device or lines.
  void continue_from(Rewindable end, FaultPlan initial_faults, std::optional<LineSpeed> speed,
                     std::string origin);
  /// Whether it was continued.
  bool is_continued() const { return !state_.origin.empty(); }
  /// Sets the part of the next tick that has passed. Precondition: there is a byte clock.
  void set_clock_remainder(Micros remainder) { state_.byte_clock->set_remainder(remainder); }

  // --- Inputs and time. Each throws only FatalFailure; the input may then be half applied.

  /// Advances time to `now`, then applies the input. No time passes if `now` is earlier than that
  /// of the input before. Precondition: it is not BytesOut; see sent().
  Applied apply(const Input& input, WallNs now, const IsEnough& is_enough = {});
  /// Removes bytes that the transport has sent from the line's outbox. It needs no time, and works
  /// on a frozen cell, too. No effect if the line is closed.
  void sent(const BytesOut& out);
  /// Advances time to `now`.
  void catch_up(WallNs now);
  /// Disables apply() and catch_up(), for the end of the process.
  void freeze() { is_frozen_ = true; }

  /// Begins a replay: time passes by replay_to() alone. The wall time of inputs must be 0.
  void begin_replay();
  /// Lets time pass to `tick`, with all bytes that are due until then. A tick in the past means
  /// now. Throws as apply() does.
  void replay_to(Tick tick);
  /// Ends a replay: time passes by the clock again, from the current tick at `now`.
  void end_replay(WallNs now);

  /// Precondition: there is no device.
  const Rewindable& checkpoint() const;
  /// Continues from a checkpoint of a cell with the same robot, profile and settings, as a replay:
  /// inputs that follow have the same effect as on that cell. Events and records of lines stay.
  /// Precondition: there is no device.
  void restore(const Rewindable& checkpoint);

  // --- Observers. They must outlive the cell, or be removed.

  enum class Ticks : std::uint8_t { kNo, kEach };
  /// From now on, the observer sees what happens, and each tick if it asks for them. It must
  /// neither add nor remove one while it is called.
  void observe(CellObserver& observer, Ticks ticks = Ticks::kNo);
  /// No effect if it does not observe.
  void end_observation(const CellObserver& observer);

  /// Reports the event that the running server has opened the cell, or is about to close it.
  void report_opened();
  void report_closed();
  /// Reports the event that the cell goes on from a recording, or cannot for this reason.
  void report_continued(const std::string& path, const std::string& why);

  // --- Queries. They tell the state after the last apply() or catch_up().

  const CellState& value() const { return state_; }
  const std::string& name() const { return state_.name; }
  const Model& model() const { return state_.model(); }
  const ModelPtr& model_ptr() const { return state_.machine.model_ptr(); }
  const State& state() const { return state_.state(); }
  const SimClock& clock() const { return state_.clock; }
  Epoch epoch() const { return state_.epoch; }
  /// The revision of the workcell, from 1.
  int model_rev() const { return state_.model_rev; }
  /// Every input and every advance of time increments it. If it is equal, nothing
  /// visible has changed.
  std::uint64_t revision() const { return revision_; }
  /// nullptr: none.
  const DeviceLink* device() const { return state_.device ? &*state_.device : nullptr; }
  /// nullptr: time does not follow bytes.
  const ByteClock* byte_clock() const { return state_.byte_clock ? &*state_.byte_clock : nullptr; }
  /// The part of the next tick that has passed on the byte clock, 0...999 microseconds; 0 without
  /// it. Epoch, tick and remainder are the whole time of the cell.
  Micros clock_remainder() const { return state_.byte_clock ? state_.byte_clock->remainder() : 0; }
  /// The transcript of this epoch; nullptr unless the clock was made by SimClock::bytes().
  const Transcript* transcript() const { return state_.transcript ? &*state_.transcript : nullptr; }
  bool is_in_past() const { return state_.in_past.has_value(); }
  bool is_frozen() const { return state_.frozen.has_value(); }
  Snapshot snapshot() const;
  /// The camera image, rendered at most once per state; nullptr if the workcell has no camera.
  ImagePtr camera_image() { return state_.machine.camera_image(); }
  /// Nothing moves, and no byte of a line is due.
  bool is_at_rest() const { return state_.is_at_rest(); }
  /// Whether time alone can produce events: the clock is real, and a motor runs or suppressed
  /// warnings have not been reported yet.
  bool has_news_to_come() const;
  const CellCounters& counters() const { return state_.counters; }

  /// nullptr if closed.
  const SerialLine* find_line(LineId line) const { return state_.find_line(line); }
  /// The open lines, numbered from 1.
  const std::map<LineId, SerialLine>& lines() const { return state_.lines; }
  /// The number of bytes that a line has received; nullopt for an unknown line, such as one that
  /// has closed long ago.
  std::optional<std::uint64_t> bytes_in(LineId line) const;
  /// The lines that an input or time has woken: see CellOutput. In order, each once.
  std::vector<LineId> take_woken_lines();

  /// The latest events, and the latest bytes of the lines with their interpretation.
  monitor::Feed& events() { return events_; }
  monitor::Feed& wires() { return wires_; }
  /// Copies events from number `seq` on, at most `count` of them, without those that the ring has
  /// dropped. Returns the number of the next one.
  std::int64_t copy_events(std::int64_t seq, std::int64_t count, std::vector<CellEvent>& to) const;
  static constexpr std::size_t kMaxEvents = 4096;
  static constexpr std::size_t kMaxWires = 1024;
  /// Estimates of the memory of an event and a record outside of their slots, with their text.
  static constexpr std::size_t kEventHeap = 256;
  static constexpr std::size_t kWireHeap = 768;

 private:
  struct Observation {
    CellObserver* observer;
    Ticks ticks;
  };

  void advance_clock(WallNs now);
  void pass_time(Tick target, std::size_t max_bytes);
  Applied act(const Input& input, WallNs now, const IsEnough& is_enough);
  void take(CellOutput& output);
  void end_tick();

  CellState state_;
  CellOutput output_;
  /// Converted to text on request, with the current model. The text of an event depends only on the
  /// robot, which never changes. Storing a model for each event would pin changed workcells.
  monitor::Ring<CellEvent> events_;
  monitor::Ring<WireRecord> wires_;
  std::vector<LineId> woken_;
  std::vector<Observation> observers_;
  std::uint64_t revision_ = 1;
  bool is_frozen_ = false;
};

}  // namespace xr3
