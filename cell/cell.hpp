// One robot: model, state, clock, epoch, serial lines, and the rings of events and line records.
// Only apply() and the passing of time change a cell. Time advances lazily, in apply() and
// catch_up(). No sockets, so that a test can run a whole server in memory. Wall time is an
// argument.
#pragma once

#include <cassert>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cell/agenda.hpp"
#include "cell/byte_clock.hpp"
#include "cell/counters.hpp"
#include "cell/input.hpp"
#include "cell/judge/watcher.hpp"
#include "cell/line_listener.hpp"
#include "cell/mirror.hpp"
#include "cell/recording/input_log.hpp"
#include "cell/transcript.hpp"
#include "cell/warning_limiter.hpp"
#include "core/sim_clock.hpp"
#include "core/simulation.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/explain/contest.hpp"
#include "protocol/explain/wire_record.hpp"
#include "protocol/monitor/feed.hpp"
#include "protocol/monitor/snapshot.hpp"

namespace xr3 {

using CellEventSink = std::function<void(const CellEvent&, const Model&)>;

class Cell final : private LineListener {
 public:
  /// Adds every event to the ring and passes it to `sink`, which may be empty. `budget` is that of
  /// the rings and must outlive the cell; null: none.
  Cell(std::string name, ModelPtr model, SimClock clock, CellEventSink sink,
       monitor::ByteBudget* budget = nullptr);
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;

  /// From now on, commands of the lines go to a physical controller while the simulator is
  /// disabled. Preconditions: no line is open, the clock is real at rate 1, and there was no
  /// device. `is_mirrored`: the simulation carries the commands out, too, and is compared with the
  /// device.
  void connect_device(std::string path, const SerialSettings& settings, bool is_mirrored = false);
  /// Sets the faults with which the cell starts, and to which a reset returns. Precondition: no
  /// line is open, and the robot has the joints.
  void set_faults(FaultPlan plan);

  /// nullptr: none.
  const DeviceLink* device() const { return device_ ? &*device_ : nullptr; }

  /// From now on, the byte clock has these rules; see byte_clock.hpp. `speed` only sets the time of
  /// a character. Preconditions: no line is open, the clock was made by SimClock::bytes(), and the
  /// lines have no speed.
  void set_byte_clock(const ByteClockSettings& settings,
                      const std::optional<LineSpeed>& speed = {});
  /// nullptr: time does not follow bytes.
  const ByteClock* byte_clock() const { return byte_clock_ ? &*byte_clock_ : nullptr; }
  /// The part of the next tick that has passed on the byte clock, 0...999 microseconds; 0 without
  /// it. Epoch, tick and remainder are the whole time of the cell.
  Micros clock_remainder() const { return byte_clock_ ? byte_clock_->remainder() : 0; }
  /// Precondition: there is a byte clock.
  void set_clock_remainder(Micros remainder) { bytes().set_remainder(remainder); }
  /// The line that a line waits for: with the byte clock, one line is obeyed at a time, and others
  /// are not read. nullopt: it does not wait, or is not open.
  std::optional<LineId> line_before(LineId line) const;
  /// The line that is obeyed now; nullopt: none is open, or all are obeyed together.
  std::optional<LineId> current_line() const;
  /// The settings that give a line's bytes their time; nullopt: they take none.
  std::optional<SerialSettings> speed_of(const SerialLine& line) const;
  /// The transcript of this epoch; nullptr unless the clock was made by SimClock::bytes().
  const Transcript* transcript() const { return transcript_ ? &*transcript_ : nullptr; }

  /// From now on, the bytes of lines take time, except on those of the monitor.
  /// Preconditions: no line is open, and there is no device.
  void set_line_speed(const LineSpeed& speed);
  /// The tick at which the next byte of a line is due; nullopt: none is.
  std::optional<Tick> next_due() const;
  /// The tick by which time must have advanced even if nobody asks for anything: a byte is due, or
  /// a fault begins or ends. At most kMaxSleep ahead; nullopt: none.
  std::optional<Tick> next_wake() const;
  static constexpr Tick kMaxSleep = Tick{3600} * kTickHz;

  /// Lines with replies that the transport does not know of, that accept bytes again, or that have
  /// nothing under way any more; in order, each once.
  std::vector<LineId> take_woken_lines();

  const std::string& name() const { return name_; }
  const Model& model() const { return simulation_.model(); }
  const ModelPtr& model_ptr() const { return simulation_.model_ptr(); }
  const SimClock& clock() const { return clock_; }
  Epoch epoch() const { return epoch_; }
  /// The revision of the workcell, from 1. Editing or replacing the workcell increments it.
  int model_rev() const { return model_rev_; }
  /// Every input and every advance of time increments it. If it is equal, nothing
  /// visible has changed.
  std::uint64_t revision() const { return revision_; }

  /// Advances time to `now`, then applies the input. No time passes if `now` is earlier than that
  /// of the input before. A call that needs the manual clock is refused with `clock_running` if the
  /// clock is real. Throws only FatalFailure; the input may then be half applied.
  Applied apply(const Input& input, WallNs now);

  /// Removes bytes that the transport has sent from the line's outbox. It needs no time, and works
  /// on a frozen cell, too. No effect if the line is closed. Throws as apply() does.
  void sent(const BytesOut& out);

  /// Advances time to `now` and emits the events of that time. Throws as apply() does.
  void catch_up(WallNs now);

  /// Calls the log for each input and for everything else on which the state depends. The log must
  /// outlive the cell or be removed. A call of the log must neither add nor remove one.
  void add_log(InputLog& log) { logs_.push_back(&log); }
  /// No effect if it is not there.
  void remove_log(const InputLog& log) { std::erase(logs_, &log); }
  /// From now on, the watcher sees events and ticks. It must outlive the cell, or end_watch() be
  /// called. A watcher must neither add nor remove one while it is called.
  void watch(CellWatcher& watcher) { watchers_.push_back(&watcher); }
  /// No effect if it does not watch.
  void end_watch(const CellWatcher& watcher) { std::erase(watchers_, &watcher); }
  /// Begins a replay: time passes by replay_to() alone. The wall time of inputs must be 0.
  void begin_replay();
  /// Lets time pass to `tick`, with all bytes that are due until then. A tick in the past means
  /// now. Throws as apply() does.
  void replay_to(Tick tick);
  /// Ends a replay: time passes by the clock again, from the current tick at `now`.
  void end_replay(WallNs now);

  /// Everything that the cell's future depends on beside its inputs, as a value.
  struct Checkpoint;
  /// Precondition: there is no device.
  Checkpoint checkpoint() const;
  /// Continues from a checkpoint of a cell with the same robot, profile, line speed and faults of
  /// the start, as a replay: inputs that follow have the same effect as on that cell. Events and
  /// records of lines stay. Precondition: there is no device.
  void restore(const Checkpoint& checkpoint);
  /// The number of the line that was opened last; 0: none.
  LineId last_line() const { return last_line_; }
  const std::optional<LineSpeed>& line_speed() const { return line_speed_; }
  const FaultPlan& initial_faults() const { return initial_faults_; }

  /// The cell was taken back: time stands, lines are not read, and calls that change the cell are
  /// refused with `in_the_past`, until the call `resume`. The clock is then as it was before.
  bool is_in_past() const { return is_in_past_; }
  /// The refusal of calls that would change a cell in its past.
  static call::Refused in_the_past();
  /// Whether the bytes of an open line wait: for another line, with a byte clock only, or because
  /// the cell is in the past.
  bool is_unread(LineId line) const { return is_in_past_ || (byte_clock_ && line_before(line)); }
  /// The model of this robot and profile with another workcell.
  ModelPtr model_with(const Workcell& workcell) const;

  /// Disables apply() and catch_up(), for the end of the process.
  void freeze() { is_frozen_ = true; }

  /// As of the last apply() or catch_up().
  const State& state() const { return simulation_.state(); }
  Snapshot snapshot() const;
  /// The camera image, rendered at most once per state; nullptr if the workcell has no camera.
  ImagePtr camera_image() { return simulation_.camera_image(); }
  /// Nothing moves, and no byte of a line is due.
  bool is_at_rest() const { return simulation_.is_at_rest() && agenda_.empty(); }
  /// Whether time alone can produce events: the clock is real, and a motor runs or suppressed
  /// warnings have not been reported yet.
  bool has_news_to_come() const {
    const bool is_asking = device_ && device_->deadline();
    return clock_.mode() == ClockMode::kReal &&
           (!is_at_rest() || warnings_.has_pending() || is_asking);
  }

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

  /// nullptr if closed.
  const SerialLine* find_line(LineId line) const;
  /// The open lines, numbered from 1.
  const std::map<LineId, SerialLine>& lines() const { return lines_; }

  /// The number of bytes that a line has received; nullopt for an unknown line. Closed lines are
  /// known until more than kRememberedLines have closed.
  std::optional<std::uint64_t> bytes_in(LineId line) const;
  static constexpr std::size_t kRememberedLines = 1024;

  /// An advance of real time stops after the tick in which this number of due bytes of lines is
  /// reached, if more are due: the clock is set back to that tick, and goes on from there.
  static constexpr std::size_t kMaxDueBytes = 256;
  /// Maximum number of due bytes of lines in a tick of the real clock; further ones wait for the
  /// next tick.
  static constexpr std::size_t kMaxTickBytes = 1024;

  /// Maximum number of named snapshots.
  static constexpr std::size_t kMaxSnapshots = 16;

  const CellCounters& counters() const { return counters_; }

  /// The tick at which a byte last arrived on a line; nullopt: none has in this epoch.
  std::optional<Tick> last_input_tick() const { return last_input_tick_; }

  /// Emits the event that the running server has opened the cell, or is about to close it.
  void report_opened() { emit(std::nullopt, CellOpenedNote{name_}); }
  void report_closed() { emit(std::nullopt, CellClosedNote{name_}); }

 private:
  SerialLine* open_line(LineId line);
  Applied take_in(const Input& input, WallNs now);
  void advance(WallNs now);
  /// The due bytes that were executed or sent in one tick.
  struct DueBytes {
    Tick tick = 0;
    std::size_t count = 0;
    void add(Tick now) {
      count = now == tick ? count + 1 : 1;
      tick = now;
    }
  };
  static constexpr std::size_t kEveryByte = std::numeric_limits<std::size_t>::max();
  void pass_time(Tick target, std::size_t max_bytes);
  std::size_t advance_to(Tick target, std::size_t max_bytes = kEveryByte);
  void run_to_rest(Tick limit);
  void simulate_to(Tick target);
  void simulate_to_rest(Tick limit);
  Applied handle(const LineOpened& opened, WallNs now);
  void handle(const LineSettings& reported, WallNs now);
  Applied handle(const BytesIn& in, WallNs now);
  void handle(const InputEnded& ended, WallNs now);
  void handle(const LineClosed& closed, WallNs now);
  void handle(const LineSilent& silent, WallNs now);
  void handle(const DeviceOpened&, WallNs now);
  void handle(const DeviceLost& lost, WallNs now);
  void handle(const DeviceIn& in, WallNs now);
  void handle(const DeviceOut& out, WallNs now);
  void handle(const Rewind& rewind, WallNs now);
  void handle(const RecordingFailed& failed, WallNs now);
  Applied handle(const call::Call& call, WallNs now);

  call::Outcome carry_out(const call::Pause&, WallNs now);
  call::Outcome carry_out(const call::Resume&, WallNs now);
  call::Outcome carry_out(const call::SetRate& rate, WallNs now);
  call::Outcome carry_out(const call::Step& step, WallNs now);
  call::Outcome carry_out(const call::RunUntil& run, WallNs now);
  call::Outcome carry_out(const call::Reset&, WallNs now);
  call::Outcome carry_out(const call::Home&, WallNs now);
  call::Outcome carry_out(const call::Key& key, WallNs now);
  call::Outcome carry_out(const call::StopDevice&, WallNs now);
  call::Outcome carry_out(const call::AlignMirror&, WallNs now);
  call::Outcome carry_out(const call::SetInput& input, WallNs now);
  call::Outcome carry_out(const call::AddBlock& add, WallNs now);
  call::Outcome carry_out(const call::MoveBlock& move, WallNs now);
  call::Outcome carry_out(const call::RemoveBlock& remove, WallNs now);
  call::Outcome carry_out(const call::ReplaceWorkcell& replace, WallNs now);
  call::Outcome carry_out(const call::SaveSnapshot& save, WallNs now);
  call::Outcome carry_out(const call::LoadSnapshot& load, WallNs now);
  call::Outcome carry_out(const call::SetFault& set, WallNs now);
  call::Outcome carry_out(const call::ClearFault& clear, WallNs now);

  void begin_epoch(std::string_view call, WallNs now, const std::function<void()>& change);
  void after_manual_advance(Tick start, WallNs now);
  void changed_model(std::string_view call, const std::string& name);
  void placed_block(std::string_view call, std::size_t block);
  void end_past();

  ByteClock& bytes() {
    assert(byte_clock_);
    return *byte_clock_;
  }
  const ByteClock& bytes() const { return const_cast<Cell&>(*this).bytes(); }
  bool is_moved_by_bytes() const { return clock_.mode() == ClockMode::kBytes && byte_clock_; }
  void byte_comes(LineId line, std::uint8_t byte) override;
  void command_comes(LineId line, const Command& command) override;
  void reply_leaves(LineId line, std::string_view reply) override;
  Micros character_time(const SerialLine& line) const;
  std::size_t receive_timed(LineId id, SerialLine& line, std::string_view bytes);
  void pass(Micros time);
  void pass_before(LineId id, Micros time);
  void pass_delays();
  void rest();
  void end_turn(LineCloseReason reason);
  void note_end(LineId line, LineCloseReason reason);
  void note_call(const call::Call& call);
  void note_settings(const SerialLine& line, const SerialSettings& reported);
  void restart_bytes();
  void mark(TranscriptMark mark);
  void after_bytes(Tick start);

  std::optional<Tick> next_due_until(Tick limit) const;
  bool act_due();
  void act_input(LineId id, SerialLine& line, Micros now);
  void send_reply(LineId id, SerialLine& line, Micros now);
  void record_acted(LineId id, SerialLine& line);
  void record_departed(LineId id, SerialLine& line);
  void release_replies(LineId id, SerialLine& line, Micros now);
  void schedule(LineId id, const SerialLine& line);
  void schedule_all();
  void restart_lines();
  std::size_t receive_piece(LineId id, SerialLine& line, std::string_view bytes);
  void deliver(LineId line, std::uint8_t reply, const Command& inquiry);
  void emit_device(DeviceNews news, DeviceNote note = {});
  CellNote note_of(EventBody event) const;
  void expire_inquiries();
  void compare_mirror(const Command& inquiry, std::uint8_t reply);
  bool loses_mirror(const EventBody& event);
  void record_out(const WirePlace& out, const SerialLine& line, std::size_t unsent);
  void emit_fault_events(LineId id, SerialLine& line);
  void note_fault(const EventBody& event);
  void emit(std::optional<LineId> line, CellNote note);
  void emit_machine_events(std::optional<LineId> line, Events events);
  void emit_time_events();
  void emit_at(Tick tick, std::optional<LineId> line, CellNote note);
  void emit_exchanges(LineId id, SerialLine& line, std::size_t first = 0);
  void emit_all(LineId line, std::vector<CellNote> notes);
  void warn(LineId line, const Parsed& parsed, std::string_view code,
            const std::function<std::string()>& message);

  std::string name_;
  Simulation simulation_;
  SimClock clock_;
  Epoch epoch_ = 0;
  int model_rev_ = 1;
  std::uint64_t revision_ = 1;
  FaultPlan initial_faults_;
  std::optional<LineSpeed> line_speed_;
  std::optional<ByteClock> byte_clock_;
  std::optional<Transcript> transcript_;
  Agenda agenda_;
  std::optional<DeviceLink> device_;  ///< before the lines, which refer to it
  std::optional<Mirror> mirror_;
  std::vector<LineId> woken_;
  std::map<LineId, SerialLine> lines_;
  LineId last_line_ = 0;
  std::map<LineId, std::uint64_t> closed_bytes_in_;  ///< of closed lines; the lowest goes first
  std::map<std::string, MachineSnapshotPtr> snapshots_;
  std::vector<Exchange> exchanges_;  ///< of the bytes being received; reuses its memory
  std::size_t emitted_ = 0;          ///< of exchanges_, while bytes move time
  WarningLimiter warnings_;
  ContestObserver contests_;
  /// Converted to text on request, with the current model. The text of an event depends only on the
  /// robot, which never changes. Storing a model for each event would pin changed workcells.
  monitor::Ring<CellEvent> events_;
  monitor::Ring<WireRecord> wires_;
  CellCounters counters_;
  std::optional<Tick> last_input_tick_;
  CellEventSink sink_;
  std::vector<InputLog*> logs_;
  std::vector<CellWatcher*> watchers_;
  DueBytes due_bytes_;
  bool is_replayed_ = false;
  bool is_in_past_ = false;
  bool was_manual_ = false;  ///< the clock, before the cell was taken back
  bool is_frozen_ = false;
};

}  // namespace xr3
