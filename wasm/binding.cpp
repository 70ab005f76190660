// The functions that the page's worker calls. Texts and bytes go through the module's memory: the
// worker writes arguments to places of xr3_alloc(), and reads the last result by xr3_text(). A
// function that can fail returns 0 then, and the text says why. Robots are pointers.
#include <cstdlib>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "wasm/page_robot.hpp"

namespace xr3 {
namespace {

constexpr double kNsPerMs = 1e6;

std::string last_text;

/// Calls a function; if it throws, keeps the reason, and returns 0.
template <class Work>
auto guarded(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::exception& failure) {
    last_text = failure.what();
    return {};
  }
}

}  // namespace
}  // namespace xr3

using xr3::guarded;
using xr3::last_text;
using xr3::PageRobot;

// Kept by the linker, which sees no caller.
#pragma GCC visibility push(default)
#define XR3_EXPORT __attribute__((used))

extern "C" {

// NOLINTBEGIN(readability-identifier-naming): names of exports

XR3_EXPORT const char* xr3_text() { return last_text.data(); }
XR3_EXPORT std::size_t xr3_text_size() { return last_text.size(); }
XR3_EXPORT void* xr3_alloc(std::size_t size) { return std::malloc(size); }
XR3_EXPORT void xr3_free(void* place) { std::free(place); }

/// `setup` as in setup.hpp. Returns the robot, or 0 with the reason as the text.
XR3_EXPORT PageRobot* xr3_create(const char* setup, std::size_t size) {
  return guarded([&] { return new PageRobot(xr3::read_setup({setup, size})); });
}
XR3_EXPORT void xr3_destroy(PageRobot* robot) { delete robot; }

// --- Time. Wall times are in ms since the robot was made.

XR3_EXPORT void xr3_set_wall(PageRobot* robot, double ms) {
  robot->set_wall(static_cast<xr3::WallNs>(ms * xr3::kNsPerMs));
}
XR3_EXPORT double xr3_wall(const PageRobot* robot) {
  return static_cast<double>(robot->wall()) / xr3::kNsPerMs;
}
XR3_EXPORT void xr3_catch_up(PageRobot* robot) { robot->catch_up(); }
XR3_EXPORT void xr3_pass(PageRobot* robot, double ticks) {
  robot->pass(static_cast<xr3::Tick>(ticks));
}
XR3_EXPORT void xr3_pause(PageRobot* robot) { robot->pause(); }
XR3_EXPORT double xr3_tick(const PageRobot* robot) {
  return static_cast<double>(robot->cell().state().tick);
}
/// 0: time follows the wall clock, 1: it stands still, 2: it follows the bytes.
XR3_EXPORT int xr3_clock(const PageRobot* robot) {
  return static_cast<int>(robot->cell().clock().mode());
}
XR3_EXPORT int xr3_is_at_rest(const PageRobot* robot) { return robot->cell().is_at_rest() ? 1 : 0; }
/// Simulated seconds per second of the wall clock.
XR3_EXPORT double xr3_rate(const PageRobot* robot) {
  return static_cast<double>(robot->cell().clock().rate().millionths) / 1e6;
}

// --- Monitors.

XR3_EXPORT std::size_t xr3_add_monitor(PageRobot* robot) { return robot->add_monitor(); }
/// Returns 0 if a part of the robot has failed; it is then of no use any more.
XR3_EXPORT int xr3_request(PageRobot* robot, std::size_t monitor, const char* message,
                           std::size_t size) {
  return guarded([&] {
    robot->monitor(monitor).handle({message, size}, robot->wall());
    return 1;
  });
}
XR3_EXPORT int xr3_offer_frames(PageRobot* robot, std::size_t monitor) {
  return guarded([&] {
    robot->monitor(monitor).offer_frames(robot->wall());
    return 1;
  });
}
/// Returns 1 if there was a message, which is the text now.
XR3_EXPORT int xr3_next_message(PageRobot* robot, std::size_t monitor) {
  const auto message = robot->monitor(monitor).next_output(robot->wall());
  if (!message) return 0;
  last_text = *message;
  return 1;
}

// --- Serial lines.

XR3_EXPORT unsigned xr3_open_line(PageRobot* robot) { return robot->open_line(); }
XR3_EXPORT std::size_t xr3_send(PageRobot* robot, unsigned line, const char* bytes,
                                std::size_t size) {
  return robot->send(line, {bytes, size});
}
/// -1: the line is closed.
XR3_EXPORT int xr3_waiting(PageRobot* robot, unsigned line) {
  const auto bytes = robot->waiting(line);
  return bytes ? static_cast<int>(*bytes) : -1;
}
/// The bytes are the text.
XR3_EXPORT std::size_t xr3_receive(PageRobot* robot, unsigned line, std::size_t most) {
  last_text = robot->receive(line, most);
  return last_text.size();
}
XR3_EXPORT void xr3_end_input(PageRobot* robot, unsigned line) { robot->end_input(line); }
XR3_EXPORT void xr3_close_line(PageRobot* robot, unsigned line) { robot->close_line(line); }

// --- The past.

/// Returns 0 if the recording is not that of such a robot; this one is then of no use any more.
XR3_EXPORT int xr3_repeat(PageRobot* robot, const char* recording, std::size_t size) {
  return guarded([&] {
    robot->repeat({recording, size});
    return 1;
  });
}

// --- Results, as the text.

XR3_EXPORT void xr3_end_recording(PageRobot* robot) { robot->end_recording(); }
XR3_EXPORT void xr3_take_recording(PageRobot* robot) { last_text = robot->take_recording(); }
XR3_EXPORT void xr3_goals(const PageRobot* robot) {
  last_text = nlohmann::json(robot->goals_now()).dump();
}
/// Whether a program has had all of the simulated time that it may have.
XR3_EXPORT int xr3_is_time_up(const PageRobot* robot) { return robot->is_time_up() ? 1 : 0; }
/// The report of a run. `why`: why the program failed; empty if it ended well.
XR3_EXPORT int xr3_finish(PageRobot* robot, const char* why, std::size_t size) {
  return guarded([&] {
    last_text = to_json(robot->finish({why, size}));
    return 1;
  });
}

// NOLINTEND(readability-identifier-naming)

}  // extern "C"

#pragma GCC visibility pop
