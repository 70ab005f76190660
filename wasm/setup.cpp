#include "wasm/setup.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cell/byte_clock.hpp"
#include "core/inverse/empty_table.hpp"
#include "protocol/files/faults.hpp"
#include "protocol/files/paper_form/paper_form.hpp"
#include "protocol/goals/file.hpp"
#include "protocol/goals/vary.hpp"
#include "protocol/recording/reader.hpp"

namespace xr3 {
namespace {

std::string text_of(const Json& object, const char* name) {
  return object.value(name, std::string());
}

ClockMode clock_of(const std::string& text) {
  if (text.empty() || text == "real") return ClockMode::kReal;
  if (text == "manual") return ClockMode::kManual;
  if (text == "bytes" || text.starts_with("bytes:")) return ClockMode::kBytes;
  throw std::invalid_argument("clock: found " + text +
                              "; allowed: real, manual, bytes, bytes:INQUIRY_MS");
}

/// Silence is measured by a server, so it has no effect in a page.
ByteClockSettings byte_clock_of(const std::string& text) {
  const ByteClockSettings settings = parse_byte_clock(text);
  if (!settings.settle_ms) return settings;
  throw std::invalid_argument("clock: found " + text + "; allowed in a page: bytes:INQUIRY_MS");
}

Profile profile_of(const std::string& name) {
  if (name.empty() || name == "paper") return Profile::kPaper;
  if (name == "mark3") return Profile::kMark3;
  throw std::invalid_argument("compat: found " + name + "; allowed: paper, mark3");
}

Workcell workcell_for(const Robot& robot, const std::string& text) {
  return text.empty() ? empty_table(Reach(robot)) : load_workcell_of_either_form(text, "workcell");
}

/// Moves the blocks as `vary` says, and notes its seed.
Workcell varied_as(PageSetup& setup, const std::string& vary, const Workcell& workcell,
                   const Robot& robot) {
  if (vary.empty()) return workcell;
  const Variation variation = parse_variation(vary);
  setup.seed = variation.seed;
  if (const auto moved = varied(workcell, robot, variation)) return *moved;
  throw std::invalid_argument("vary: found " + vary +
                              ", with which there is no place for a block; allow more mm");
}

void take_files(PageSetup& setup, const Json& object) {
  const Robot robot = load_robot_of_either_form(object.at("robot").get<std::string>(), "robot");
  const Workcell workcell = varied_as(setup, text_of(object, "vary"),
                                      workcell_for(robot, text_of(object, "workcell")), robot);
  recording::Header& header = setup.header;
  const std::string clock = text_of(object, "clock");
  header.cell = "main";
  header.mode = clock_of(clock);
  if (header.mode == ClockMode::kBytes) header.byte_clock = byte_clock_of(clock);
  header.model =
      std::make_shared<const Model>(robot, workcell, profile_of(text_of(object, "compat")));
  if (const std::string text = text_of(object, "faults"); !text.empty())
    header.faults = load_faults(text, "faults", header.model->labels());
}

recording::Header header_of_recording(const std::string& text) {
  recording::RecordingReader reader("recording");
  reader.add(text);
  const auto header = reader.header();
  if (!header) throw std::invalid_argument("recording: it has no first line");
  if (header->device)
    throw std::invalid_argument("recording: it is of a robot with a physical controller at " +
                                header->device->path +
                                ", which a page has not; `xr3 replay` repeats it");
  return *header;
}

PageSetup setup_of(const Json& object) {
  PageSetup setup;
  setup.product = text_of(object, "product");
  const std::string recorded = text_of(object, "recording");
  if (recorded.empty())
    take_files(setup, object);
  else
    setup.header = header_of_recording(recorded);
  if (const std::string text = text_of(object, "goals"); !text.empty())
    setup.goals = load_goals(text, "goals", *setup.header.model);
  return setup;
}

}  // namespace

PageSetup read_setup(std::string_view json) {
  try {
    return setup_of(Json::parse(json));
  } catch (const Json::exception& wrong) {
    throw std::invalid_argument(std::string("the setup of the robot: ") + wrong.what());
  }
}

}  // namespace xr3
