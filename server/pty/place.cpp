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
  assert(failure_);
  try {
    std::rethrow_exception(failure_);
  } catch (const std::exception& error) {
    return error.what();
  }
}

// --- For the thread.

void PtyPlace::poll() {
  const Stage stage = stage_;
  if (stage == Stage::kIdle) look_for_program();
  if (stage == Stage::kServed) tell_line();
}

// A program that has changed the modes and left again, such as `stty -F PATH`, is no line.
void PtyPlace::look_for_program() {
  const PseudoTerminal::State state = terminal_.poll();
  if (state.is_open || state.has_bytes)
    stage_ = Stage::kArrived;
  else if (!terminal_.is_raw())
    try_to_prepare();
}

void PtyPlace::tell_line() {
  PseudoTerminal::State state = terminal_.poll();
  if (!state.is_open && !state.has_bytes) state = make_ready();
  is_leaving_ = !state.is_open;
  if (state.has_room || !state.is_open) has_room_ = true;
  news_.give();
}

// Another program may have opened the terminal since: the line goes on with it.
PseudoTerminal::State PtyPlace::make_ready() {
  const std::scoped_lock use(use_);
  const PseudoTerminal::State state = terminal_.poll();
  if (state.is_open || state.has_bytes) return state;
  is_unready_ = !try_to_prepare();
  Stage served = Stage::kServed;  // unless the server has ended the line meanwhile
  stage_.compare_exchange_strong(served, Stage::kLeft);
  return state;
}

bool PtyPlace::try_to_prepare() const {
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
  stage_ = Stage::kIdle;
}

void PtyPlace::fail() {
  assert(stage_ == Stage::kDropped || stage_ == Stage::kFailed);
  if (stage_ != Stage::kFailed) failure_ = std::current_exception();
  stage_ = Stage::kFailed;
}

}  // namespace xr3
