// A cell with all parts of the server that belong to it alone: its serial lines, its ports, its
// timers, and the frames and subscribers of its channels.
//
// The flow through the folder: seed.hpp loads the files of a cell and makes a HostedCell of them.
// The registry (registry.hpp) holds the cells of the server by name and by token; a cell lives as
// long as a shared pointer to it. Three callers add cells: the App at the start, ConnectionCells
// (connection_cells.hpp) for each connection of `--cell-per-connection`, and BranchCells
// (branch_cells.hpp) for copies of a cell's past. With `--continue`, Comebacks (comebacks.hpp) lets
// planned cells go on from their recordings; until then a cell is absent (absence.hpp), and clients
// wait. attention.hpp and live_goals.hpp observe a cell for the overview. After each input, from
// whatever port, runs after_input(): it wakes the lines whose replies have become due, sets the
// timers for due bytes and for silence, passes bytes on to a physical controller, and notifies the
// subscribers. A cell that is closed while the server runs ends its lines, leaves the registry, and
// is retired: a request of the monitor may still hold it, but it arms no timer and takes no input.
#pragma once

#include <cassert>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/frames.hpp"
#include "cell/history/history.hpp"
#include "server/cells/absence.hpp"
#include "server/cells/attention.hpp"
#include "server/cells/event_forwarder.hpp"
#include "server/cells/live_goals.hpp"
#include "server/device/port.hpp"
#include "server/http/pictures.hpp"
#include "server/lines/due_timer.hpp"
#include "server/lines/hold_timer.hpp"
#include "server/lines/sessions.hpp"
#include "server/lines/silence_timer.hpp"
#include "server/net/asio.hpp"
#include "server/net/worker.hpp"
#include "server/options/options.hpp"
#include "server/pty/port.hpp"
#include "server/recording/daily_files.hpp"
#include "server/recording/recording.hpp"
#include "server/robot_port/port.hpp"
#include "server/session/subscribers.hpp"

namespace xr3 {

class HostedCell;
using CellPtr = std::shared_ptr<HostedCell>;

/// Shared by all cells of the process; must outlive them.
struct CellContext {
  asio::io_context& io;
  LineTurns& turns;
  Worker& worker;
  std::function<void(HostedCell&)> on_input;  ///< called after each input of a cell
  monitor::ByteBudget* rings = nullptr;       ///< limit for the rings of all cells; nullptr if none
  monitor::ByteBudget* histories = nullptr;   ///< limit for the histories of all cells
};

/// The parts with which a cell begins.
struct CellParts {
  std::string name;
  ModelPtr model;
  SimClock clock;
  EventSink sink;          ///< may be empty
  std::string token = {};  ///< token of this cell; empty if it has none
};

class HostedCell : public std::enable_shared_from_this<HostedCell> {
 public:
  /// Not by std::make_shared: a weak pointer would keep the whole memory.
  static CellPtr make(CellContext& context, CellParts parts) {
    return CellPtr(new HostedCell(context, std::move(parts)));
  }
  HostedCell(const HostedCell&) = delete;
  HostedCell& operator=(const HostedCell&) = delete;
  /// Lines that are still open end without a report.
  ~HostedCell();

  const std::string& name() const { return cell_.name(); }
  /// Empty if it has none.
  const std::string& token() const { return token_; }
  Cell& cell() { return cell_; }
  const Cell& cell() const { return cell_; }
  LineSessions& lines() { return lines_; }
  /// The lines, as far as the calls of the monitor need them.
  LineTransports& transports() { return lines_; }
  FrameCache& frames() { return frames_; }
  SubscriberHub& hub() { return hub_; }
  http::Pictures& pictures() { return pictures_; }

  /// Opens the robot port of the cell. Precondition: there is none yet.
  RobotPort& add_port(RobotPortRules rules);
  /// nullptr if it has none.
  RobotPort* port() const { return port_.get(); }
  /// Serves pseudo-terminals. Throws FileError.
  void serve_terminals(const std::vector<std::string>& paths, ::mode_t rights);
  /// Connects a physical controller, which open_device() opens; see Cell::connect_device().
  void connect_device(const DeviceChoice& device, bool is_mirrored);
  /// Throws SerialDeviceError. Precondition: connect_device() was called.
  void open_device() {
    assert(device_);
    device_->open();
  }

  /// Records the cell in this new file, before its first input; see recording.hpp. Throws
  /// FileError.
  void record(std::string path, RecordingLimits limits);
  /// Records the cell in a new file each day: see DailyFiles. `new_path` makes the path of a file,
  /// and may throw FileError.
  void record_daily(std::function<std::string()> new_path, RecordingLimits limits);
  /// The cell gets no more input.
  void finish_recording();

  /// Keeps the cell's past of the last `longest` ticks. Precondition: the cell has no device, and
  /// the context has a budget.
  void keep_history(Tick longest) {
    assert(!device_ && context_.histories != nullptr);
    history_.emplace(cell_, longest, *context_.histories);
  }
  /// nullptr if none is kept.
  const History* history() const { return history_ ? &*history_ : nullptr; }

  /// The cell is absent until come_back(): connections of its port are not accepted, and requests
  /// wait. `wanted`: see Absence. Precondition: it has a port, and has had no input.
  void leave(std::function<void()> wanted);
  bool is_absent() const { return absence_.has_value(); }
  /// Waits until the cell has come back, and asks for it; at once unless it is absent.
  asio::awaitable<void> be_back();
  void come_back();

  /// Shows which goals of the exercise are met.
  void follow_goals(std::shared_ptr<const LiveExercise> exercise) {
    goals_.emplace(cell_, std::move(exercise));
  }
  /// nullptr if it has none.
  const LiveGoals* goals() const { return goals_ ? &*goals_ : nullptr; }
  /// Fills in what a lesson needs of the programs and the goals.
  void describe(monitor::CellSummary& summary) const;

  /// To be called after an input of the cell: serves its lines and subscribers.
  void after_input();

  /// Accepts no further clients; the lines end as LineSessions::close() says.
  void close_ports();
  void close(WallNs deadline = kNever);
  /// Closes the cell for good: it arms no timer, and ignores inputs of those that still hold it.
  /// Precondition: its lines have ended.
  void retire();
  bool is_retired() const { return is_retired_; }
  /// Ignores all further inputs, for the end of the process.
  void freeze();

  /// A shared pointer to one of its parts, which keeps the cell.
  template <class Part>
  std::shared_ptr<Part> share(Part& part) {
    return {shared_from_this(), &part};
  }

 private:
  HostedCell(CellContext& context, CellParts parts);

  CellContext& context_;
  std::string token_;
  EventForwarder events_;
  Cell cell_;
  Attention attention_;
  std::optional<LiveGoals> goals_;
  std::optional<DailyFiles> daily_files_;
  std::optional<Recording> recording_;
  std::optional<History> history_;
  LineSessions lines_;
  DueTimer due_timer_;
  SilenceTimer silence_timer_;
  HoldTimer hold_timer_;
  std::unique_ptr<RobotPort> port_;
  std::unique_ptr<PtyPort> ptys_;
  std::optional<DevicePort> device_;
  FrameCache frames_;
  SubscriberHub hub_;
  http::Pictures pictures_;
  std::optional<Absence> absence_;
  bool is_retired_ = false;
  bool is_frozen_ = false;
};

}  // namespace xr3
