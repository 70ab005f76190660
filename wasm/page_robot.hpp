// A robot that lives in a page: a cell with its past, its recording and its judge, without a
// server. The page's worker passes it requests, bytes and the time.
//
// The flow through the folder: binding.cpp has the functions that the worker calls, with texts in
// memory. Each works on a PageRobot (page_robot.hpp). It is made from the texts of its files
// (setup.hpp). It has monitors (service/cell_monitor.hpp), one for the page and one for each
// connection that a program makes to the monitor port, and lines, one for each connection to the
// robot port. Nothing happens by itself: time passes when the worker says so.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cell/history/history.hpp"
#include "cell/judge/run_observer.hpp"
#include "cell/judge/sim_limit.hpp"
#include "cell/recording/recorder.hpp"
#include "protocol/recording/writer.hpp"
#include "service/cell_monitor.hpp"
#include "tools/report/run_report.hpp"
#include "wasm/setup.hpp"

namespace xr3 {

class PageRobot {
 public:
  explicit PageRobot(PageSetup setup);
  PageRobot(const PageRobot&) = delete;
  PageRobot& operator=(const PageRobot&) = delete;

  const Cell& cell() const { return *cell_; }

  // --- Time.

  /// Sets the wall time of what follows, in ns since the robot was made; an earlier one than before
  /// has no effect. Time passes with the next input or pass_to().
  void set_wall(WallNs wall);
  WallNs wall() const { return wall_; }
  /// Lets time pass to the wall time.
  void catch_up() { cell_->catch_up(wall_); }
  /// Lets this many ticks pass, however long they take by the wall clock, which goes on with them.
  /// No effect while time stands still, or with the byte clock.
  void pass(Tick ticks);
  /// Stops time. No effect if it does not follow the wall clock.
  void pause();

  // --- Monitors.

  /// Its first message is `hello`. Monitors are numbered from 0 and never removed.
  std::size_t add_monitor();
  /// Precondition: there is such a monitor.
  service::CellMonitor& monitor(std::size_t number) { return *monitors_.at(number); }

  // --- Serial lines.

  LineId open_line();
  /// Returns the number of bytes that the line has taken; 0 if it is closed.
  std::size_t send(LineId line, std::string_view bytes);
  /// The number of bytes that can be received; nullopt if the line is closed.
  std::optional<std::size_t> waiting(LineId line);
  /// At most so many bytes.
  std::string receive(LineId line, std::size_t most);
  /// The client sends no more bytes: the line closes when all replies have been received.
  void end_input(LineId line);
  /// No effect if it is closed.
  void close_line(LineId line);

  // --- The past.

  /// Repeats the recording of a robot with this setup: this robot is then where that one was at its
  /// end, except that its lines are closed. Throws DataError if the text is no recording, and
  /// std::runtime_error if the robot does not do the same. Precondition: nothing has happened.
  void repeat(std::string_view recording);

  // --- Results.

  /// The lines of the recording since the last call. Together they are a file that xr3 replays.
  std::string take_recording() { return std::exchange(recording_, {}); }
  /// Ends the recording at the current tick; no effect if it has ended.
  void end_recording();
  /// Whether each goal is met now; empty without goals.
  std::vector<bool> goals_now() const;
  /// Whether a program has had the simulated time that `xr3 exec` gives it; only with goals and the
  /// byte clock.
  bool is_time_up() const { return limit_ && limit_->moment(); }
  /// Ends the run as `xr3 exec` does: the robot comes to rest, the recording ends, and the goals
  /// are judged. `failure`: why the program failed; empty if it ended well. The report has no name,
  /// no wall time and no picture.
  RunReport finish(std::string failure);

 private:
  void close_if_over(LineId line);
  void record(const recording::Entry& entry) { recording_ += writer_.line(entry); }

  PageSetup setup_;
  WallNs wall_ = 0;
  std::shared_ptr<Cell> cell_;
  monitor::ByteBudget memory_;
  recording::RecordingWriter writer_;
  std::string recording_;  ///< lines that were not taken yet
  Recorder recorder_;
  History history_;
  RunObserver observer_;
  std::optional<SimLimit> limit_;
  std::vector<std::unique_ptr<service::CellMonitor>> monitors_;
  bool is_recording_ = true;
};

}  // namespace xr3
