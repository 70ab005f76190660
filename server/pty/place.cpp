#include "server/pty/place.hpp"

#include <cassert>
#include <utility>

#include "server/files/data_files.hpp"

namespace xr3 {

PtyPlace::PtyPlace(const std::string& path, ::mode_t rights)
    : rights_(rights), terminal_(rights), link_(path, terminal_.slave()) {}

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
  assert(stage_ == Stage::kFailed);
  try {
    std::rethrow_exception(failure_);
  } catch (const std::exception& error) {
    return error.what();
  }
}

// --- For the thread.

void PtyPlace::attend() {
  const Stage stage = stage_;
  const PseudoTerminal::State state = terminal_.poll();
  if (stage == Stage::kServed) follow(state);
  if (stage == Stage::kIdle && (state.is_open || state.has_bytes)) stage_ = Stage::kArrived;
}

void PtyPlace::follow(const PseudoTerminal::State& state) {
  is_leaving_ = !state.is_open;
  if (state.has_room || !state.is_open) has_room_ = true;
  if (!state.is_open && !state.has_bytes) make_ready();
  news_.give();
}

// Another program may have opened the terminal since: the line goes on with it.
void PtyPlace::make_ready() {
  const std::scoped_lock use(use_);
  const PseudoTerminal::State state = terminal_.poll();
  if (state.is_open || state.has_bytes) return;
  try {
    terminal_.prepare();
  } catch (const FileError&) {
    is_unready_ = true;
  }
  Stage served = Stage::kServed;  // unless the server has ended the line meanwhile
  stage_.compare_exchange_strong(served, Stage::kLeft);
}

void PtyPlace::renew() {
  assert(stage_ == Stage::kDropped || stage_ == Stage::kFailed);
  PseudoTerminal fresh(rights_);
  link_.point_to(fresh.slave());
  terminal_ = std::move(fresh);
  stage_ = Stage::kIdle;
}

void PtyPlace::fail() {
  if (stage_ != Stage::kFailed) failure_ = std::current_exception();
  stage_ = Stage::kFailed;
}

}  // namespace xr3
