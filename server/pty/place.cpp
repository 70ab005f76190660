#include "server/pty/place.hpp"

#include <cassert>
#include <utility>

namespace xr3 {

PtyPlace::PtyPlace(const std::string& path, ::mode_t rights)
    : terminal_(rights), link_(path, terminal_.slave()) {}

// --- For the event loop.

void PtyPlace::begin_line() {
  assert(stage_ == Stage::kArrived);
  is_leaving_ = false;
  is_unready_ = false;
  stage_ = Stage::kServed;
}

void PtyPlace::end_line(bool is_dropped) {
  [[maybe_unused]] const Stage stage = stage_;
  assert(stage == Stage::kLeft || (is_dropped && stage == Stage::kServed));
  const bool is_to_be_replaced = is_dropped || std::exchange(is_unready_, false);
  stage_ = is_to_be_replaced ? Stage::kDropped : Stage::kIdle;
}

std::string PtyPlace::failure() const {
  const std::scoped_lock use(failure_use_);
  assert(failure_);
  try {
    std::rethrow_exception(failure_);
  } catch (const std::exception& error) {
    return error.what();
  }
}

// --- For the thread.

bool PtyPlace::poll() {
  const Stage stage = stage_;
  if (stage == Stage::kIdle) return look_for_program();
  if (stage == Stage::kServed) return report_to_line();
  return false;
}

// A program that has only changed the settings, such as `stty -F PATH`, is no line.
bool PtyPlace::look_for_program() {
  const PseudoTerminal::State state = terminal_.poll();
  if (state.is_open || state.has_bytes) {
    stage_ = Stage::kArrived;
    return false;
  }
  if (!was_opened_) return false;
  if (!try_to_prepare()) stage_ = Stage::kDropped;
  return true;
}

bool PtyPlace::report_to_line() {
  PseudoTerminal::State state = terminal_.poll();
  const bool is_left = !state.is_open && !state.has_bytes && try_to_leave(state);
  is_leaving_ = !state.is_open;
  if (state.has_room || !state.is_open) has_room_ = true;
  news_.give();
  return is_left;
}

// Another program may have opened the terminal since: the line goes on with it.
bool PtyPlace::try_to_leave(PseudoTerminal::State& state) {
  const std::scoped_lock use(use_);
  state = terminal_.poll();
  if (state.is_open || state.has_bytes) return false;
  is_unready_ = !try_to_prepare();
  Stage served = Stage::kServed;  // unless the server has ended the line meanwhile
  stage_.compare_exchange_strong(served, Stage::kLeft);
  return true;
}

bool PtyPlace::try_to_prepare() {
  was_opened_ = false;
  try {
    terminal_.prepare();
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

void PtyPlace::replace(PseudoTerminal fresh) {
  assert(stage_ == Stage::kDropped || stage_ == Stage::kFailed);
  link_.point_to(fresh.slave());
  terminal_ = std::move(fresh);
  was_opened_ = false;
  stage_ = Stage::kIdle;
}

void PtyPlace::fail() {
  assert(stage_ == Stage::kDropped || stage_ == Stage::kFailed);
  const std::scoped_lock use(failure_use_);
  if (stage_ != Stage::kFailed) failure_ = std::current_exception();
  stage_ = Stage::kFailed;
}

}  // namespace xr3
