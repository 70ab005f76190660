#include "wasm/page_robot.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "cell/judge/passive.hpp"
#include "cell/recording/replayer.hpp"
#include "cell/recording/state_hash.hpp"
#include "protocol/goals/credit.hpp"
#include "protocol/goals/goal_text.hpp"
#include "protocol/goals/judge.hpp"
#include "protocol/recording/reader.hpp"

namespace xr3 {
namespace {

// As `xr3 serve` has by default, but for the memory: a page has less.
constexpr Tick kHistory = 3600 * kTickHz;
constexpr std::size_t kHistoryBytes = std::size_t{32} * 1024 * 1024;

std::shared_ptr<Cell> make_cell(const recording::Header& header) {
  auto cell = std::make_shared<Cell>(header.cell, header.model, replay_clock(header));
  prepare_replay(*cell, header);
  return cell;
}

}  // namespace

PageRobot::PageRobot(PageSetup setup)
    : setup_(std::move(setup)),
      cell_(make_cell(setup_.header)),
      memory_(kHistoryBytes),
      recording_(writer_.line(recording_header(*cell_, setup_.product))),
      recorder_([this](const recording::Entry& entry) { record(entry); }),
      history_(*cell_, kHistory, memory_),
      observer_(*cell_, setup_.goals) {
  cell_->observe(recorder_);
  if (setup_.header.mode == ClockMode::kBytes && !setup_.goals.goals.empty())
    limit_.emplace(*cell_, observer_, kUsualSimLimit);
}

// --- Time.

void PageRobot::set_wall(WallNs wall) { wall_ = std::max(wall_, wall); }

void PageRobot::pass(Tick ticks) {
  const SimClock& clock = cell_->clock();
  if (clock.mode() != ClockMode::kReal) return;
  set_wall(clock.when(cell_->state().tick + ticks));
  catch_up();
}

void PageRobot::pause() {
  if (cell_->clock().mode() == ClockMode::kReal)
    cell_->apply(Input{call::Call{call::Pause{}}}, wall_);
}

// --- Monitors.

std::size_t PageRobot::add_monitor() {
  catch_up();
  monitors_.push_back(std::make_unique<service::CellMonitor>(setup_.product, cell_, &history_));
  return monitors_.size() - 1;
}

// --- Serial lines.

LineId PageRobot::open_line() {
  return cell_->apply(LineOpened{"program", LineKind::kTcp}, wall_).line;
}

std::size_t PageRobot::send(LineId line, std::string_view bytes) {
  if (cell_->find_line(line) == nullptr) return 0;
  const std::size_t taken = cell_->apply(BytesIn{line, bytes}, wall_).bytes_taken;
  close_if_over(line);
  return taken;
}

/// Closes the line for the reasons for which a server closes one, after its replies are received.
void PageRobot::close_if_over(LineId line) {
  const SerialLine* open = cell_->find_line(line);
  if (open == nullptr) return;
  if (open->is_not_a_robot_program()) {
    cell_->apply(LineClosed{line, LineCloseReason::kNotARobotProgram}, wall_);
    return;
  }
  const bool is_cut = open->is_cut();
  if (is_cut && !open->has_input_ended()) cell_->apply(InputEnded{line}, wall_);
  if (!open->has_input_ended() || !open->outbox().empty() || !open->is_drained()) return;
  cell_->apply(LineClosed{line, is_cut ? LineCloseReason::kFault : LineCloseReason::kClientClosed},
               wall_);
}

std::optional<std::size_t> PageRobot::waiting(LineId line) {
  close_if_over(line);
  const SerialLine* open = cell_->find_line(line);
  if (open == nullptr) return std::nullopt;
  return open->outbox().size();
}

std::string PageRobot::receive(LineId line, std::size_t most) {
  const SerialLine* open = cell_->find_line(line);
  if (open == nullptr) return {};
  std::string bytes(open->outbox().substr(0, most));
  cell_->sent({line, bytes.size()});
  return bytes;
}

void PageRobot::end_input(LineId line) {
  const SerialLine* open = cell_->find_line(line);
  if (open == nullptr || open->has_input_ended()) return;
  cell_->apply(InputEnded{line}, wall_);
  close_if_over(line);
}

void PageRobot::close_line(LineId line) {
  end_input(line);
  if (cell_->find_line(line) == nullptr) return;
  cell_->apply(LineClosed{line, LineCloseReason::kClientClosed}, wall_);
}

// --- The past.

void PageRobot::repeat(std::string_view recording) {
  recording::RecordingReader reader("recording");
  reader.add(recording);
  const auto header = reader.header();
  if (!header) throw std::runtime_error("recording: it has no first line");
  cell_->begin_replay();
  {
    Replayer replayer(*cell_,
                      header->state_format == kStateFormat ? Compared::kAll : Compared::kReplies);
    while (const auto entry = reader.next())
      if (const auto difference = replayer.apply(*entry))
        throw std::runtime_error("recording:" + std::to_string(reader.line()) +
                                 ": this version does otherwise: " + to_text(*difference));
  }
  reader.end();
  cell_->end_replay(wall_);
  while (!cell_->lines().empty()) close_line(cell_->lines().begin()->first);
}

// --- Results.

void PageRobot::end_recording() {
  if (!std::exchange(is_recording_, false)) return;
  record(recorder_.end_of(*cell_, "stopped"));
  cell_->end_observation(recorder_);
}

std::vector<bool> PageRobot::goals_now() const {
  std::vector<bool> met;
  for (const GoalResult& each :
       judge(setup_.goals, cell_->model(), cell_->state(), observer_.facts()))
    met.push_back(each.is_met);
  return met;
}

RunReport PageRobot::finish(std::string failure) {
  pause();
  const Tick rest = limit_ ? limit_->left(kRestLimit) : kRestLimit;
  cell_->apply(Input{call::Call{call::RunUntil{std::nullopt, rest}}}, wall_);
  end_recording();
  JudgedMoment end = is_time_up() ? *limit_->moment() : moment_of(*cell_, observer_);
  RunReport report;
  report.outcome = failure.empty() ? RunOutcome::kFinished : RunOutcome::kFailed;
  report.why = std::move(failure);
  if (is_time_up()) {
    report.outcome = RunOutcome::kTimeUp;
    report.why = "the limit of " + seconds_text(kUsualSimLimit) + " simulated seconds was reached";
  }
  report.ticks = end.state.tick;
  report.bytes = end.facts.bytes;
  report.seed = setup_.seed;
  report.transcript = std::move(end.transcript);
  report.goals = judge(setup_.goals, cell_->model(), end.state, end.facts);
  const std::vector<bool> passive =
      passive_goals(setup_.goals, setup_.header.model, setup_.header.faults);
  report.not_counted = withhold(report.goals, setup_.goals, passive, report.outcome, end.facts);
  return report;
}

}  // namespace xr3
