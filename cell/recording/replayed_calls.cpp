// The calls of a recording. Those that advance a manual clock do so piece by piece, for samples and
// for the time to stop. With the byte clock such a call may let further time pass at its end, so it
// is made at once.
#include <algorithm>

#include "cell/digest.hpp"
#include "cell/recording/replayer.hpp"
#include "protocol/monitor/request.hpp"
#include "protocol/monitor/request_error.hpp"
#include "protocol/monitor/saved_cell.hpp"

namespace xr3 {

Replayer::Result Replayer::make_call(const call::Call& call) {
  is_stopped_ = call::traits_of(call).begins_epoch && stop_ == now();
  if (is_stopped_) return std::nullopt;
  ++inputs_;
  if (const auto* wanted = std::get_if<call::Step>(&call)) return step(*wanted);
  if (const auto* wanted = std::get_if<call::RunUntil>(&call)) return run_until(*wanted);
  const auto* load = std::get_if<call::LoadSnapshot>(&call);
  if (load != nullptr && load->saved && load->saved->robot_hash == robot_hash(cell_.model())) {
    const auto details = monitor::validate(cell_.model(), *load->saved);
    if (!details.empty())
      return difference("snapshot", "one that fits the robot", "another at " + details[0].pointer);
  }
  const Epoch epoch = cell_.epoch();
  const Applied applied = cell_.apply(Input{call}, 0);
  if (cell_.epoch() != epoch) next_sample_ = now();
  const auto* refused = std::get_if<call::Refused>(&applied.outcome);
  if (refused == nullptr) return std::nullopt;
  return difference("call", "accepted", "refused: " + refused->message);
}

Replayer::Result Replayer::rewind(const SavedCell& saved) {
  const bool is_same = saved.robot_hash == robot_hash(cell_.model());
  const auto details =
      is_same ? monitor::validate(cell_.model(), saved) : std::vector<monitor::Detail>{};
  if (!is_same || !details.empty())
    return difference("seek", "a state that fits the robot",
                      is_same ? "another at " + details[0].pointer : "one of another robot");
  ++inputs_;
  auto past = std::make_shared<const MachineSnapshot>(
      MachineSnapshot{cell_.value().model_with(saved.workcell), saved.state});
  cell_.apply(Rewind{std::move(past), {}}, 0);
  next_sample_ = now();
  return std::nullopt;
}

/// The last tick to which a call may let time pass.
Tick Replayer::tick_limit(Tick wanted) const {
  const bool is_limited = stop_ && stop_->epoch == cell_.epoch();
  return is_limited ? std::min(wanted, std::max(stop_->tick, cell_.state().tick)) : wanted;
}

/// Whether a sample is due before a call has advanced a manual clock to `target`.
bool Replayer::has_sample(Tick target) const {
  return every_ > 0 && cell_.clock().mode() == ClockMode::kManual && next_sample_.tick <= target;
}

Replayer::Result Replayer::step(const call::Step& step) {
  if (cell_.clock().mode() == ClockMode::kReal || step.ticks > monitor::kMaxInteger - now().tick)
    return difference("step", "no real clock, and time before its end", "another");
  const Tick wanted = cell_.state().tick + step.ticks;
  const Tick target = tick_limit(wanted);
  is_stopped_ = target < wanted;
  do {
    const bool is_sampled = has_sample(target);
    const Tick next = is_sampled ? std::max(next_sample_.tick, cell_.state().tick) : target;
    cell_.apply(Input{call::Call{call::Step{next - cell_.state().tick}}}, 0);
    if (is_sampled) sample();
  } while (cell_.state().tick < target);
  return std::nullopt;
}

Replayer::Result Replayer::run_until(const call::RunUntil& run) {
  if (cell_.clock().mode() == ClockMode::kReal)
    return difference("run_until", "no real clock", "the real one");
  const Tick room = std::min(run.max_ticks, monitor::kMaxInteger - cell_.state().tick);
  const Tick wanted = cell_.state().tick + room;
  const Tick target = tick_limit(wanted);
  for (bool is_done = false; !is_done;) {
    const bool is_sampled = has_sample(target);
    const Tick next = is_sampled ? std::max(next_sample_.tick, cell_.state().tick) : target;
    const call::RunUntil piece{run.tick, next - cell_.state().tick};
    const Applied applied = cell_.apply(Input{call::Call{piece}}, 0);
    const bool is_reached = std::get<call::Done>(applied.outcome).reached.value_or(false);
    if (is_sampled && cell_.state().tick >= next_sample_.tick) sample();
    is_done = is_reached || cell_.state().tick >= target;
    is_stopped_ = !is_reached && target < wanted;
  }
  return std::nullopt;
}

}  // namespace xr3
