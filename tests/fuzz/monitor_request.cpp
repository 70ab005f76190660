// Fuzzes the reader of the monitor's requests: any bytes give a request or an error; an accepted
// saved cell is equal after writing and reading; and if it is valid for the Rhino, a machine
// continues from it, is drawn and is seen by the camera.
//
// Input: one message.
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "core/camera.hpp"
#include "core/drawing/status_line.hpp"
#include "core/drawing/wireframe.hpp"
#include "core/simulation.hpp"
#include "protocol/monitor/heading.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request.hpp"
#include "protocol/monitor/request_error.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/support/models.hpp"

namespace xr3::fuzz::monitor_request_fuzzer {
namespace {

using namespace monitor;  // NOLINT: the subject of this file

constexpr int kMaxPixels = 65536;  ///< larger images only take time

/// Uses a state in all ways: messages, commands of a line, and ticks.
void exercise(const SavedCell& saved) {
  Simulation simulation(std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                                      saved.workcell, Profile::kPaper));
  simulation.restore(saved.state);
  const auto& camera = saved.workcell.camera;
  if (camera && camera->pixels_x * camera->pixels_y <= kMaxPixels)
    camera_image(simulation.model(), simulation.state());
  wireframe(simulation.model(), simulation.state());
  view_along(simulation.state().display.view);
  status_line(simulation.model(), simulation.state());
  simulation.advance_to(simulation.tick() + 300);
  for (const char label : {'F', 'E'}) simulation.execute(Move{label, -100});
  for (int i = 0; i < 2; ++i) simulation.execute(Move{'A', 100});
  simulation.execute(ToggleErasing{});
  simulation.advance_to(simulation.tick() + 300);
  simulation.execute(Move{'A', -100});
  simulation.run_to_rest(simulation.tick() + 100'000);
  state_json(simulation.model(), {0, ClockMode::kReal, {}, 1, simulation.state(), {}});
  simulation.execute(SoftHome{});
}

void load(const SavedCell& saved) {
  const FileReading<SavedCell> again = read_saved_cell(saved_cell_to_json(saved));
  require(again.value && *again.value == saved, "the saved cell written and read again");
  if (validate(*test::rhino(), saved).empty()) exercise(saved);
}

/// The heading, read before the message is parsed, agrees with the parsed request.
void check(const Request& request, std::string_view text) {
  require(!request.cell || request.cell->size() <= text.size(), "a cell that was named");
  const Heading before = heading_of(text);
  const Heading after = heading_of(request);
  require(before.id == after.id || before.id == RequestId(), "the heading's id, unless it is long");
  require(before.fn == after.fn || after.fn.empty(), "the heading's fn");
  require(after.op.empty() || before.op == after.op, "the heading's op");
  const auto* wanted = std::get_if<CallRequest>(&request.what);
  if (wanted == nullptr) return;
  const auto* of_cell = std::get_if<call::Call>(&wanted->call);
  if (of_cell == nullptr) return;
  const auto* snapshot = std::get_if<call::LoadSnapshot>(of_cell);
  if (snapshot == nullptr) return;
  require(snapshot->name.empty() == (snapshot->saved != nullptr), "a name or a saved cell");
  if (snapshot->saved) load(*snapshot->saved);
}

void check(const RequestError& error) {
  require(!error.code.empty() && !error.message.empty(), "an error says what is wrong");
  require(error.code != "bad_args" || !error.details.empty(), "invalid args have details");
  require(!Json::parse(*result(error)).is_discarded(), "an answer is JSON");
}

void run(std::string_view input, Effort /*all inputs are alike*/) {
  const RequestReading reading = read_request(input);
  if (const auto* request = std::get_if<Request>(&reading)) check(*request, input);
  if (const auto* error = std::get_if<RequestError>(&reading)) check(*error);
}

const Registration kRegistration{{"monitor_request", 2048, run}};

}  // namespace
}  // namespace xr3::fuzz::monitor_request_fuzzer
