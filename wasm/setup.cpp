#include "wasm/setup.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/inverse/empty_table.hpp"
#include "protocol/files/faults.hpp"
#include "protocol/files/paper_form/paper_form.hpp"
#include "protocol/goals/file.hpp"
#include "protocol/recording/reader.hpp"

namespace xr3 {
namespace {

std::string text_of(const Json& object, const char* name) {
  return object.value(name, std::string());
}

ClockMode clock_of(const std::string& name) {
  if (name.empty() || name == "real") return ClockMode::kReal;
  if (name == "manual") return ClockMode::kManual;
  if (name == "bytes") return ClockMode::kBytes;
  throw std::invalid_argument("clock: found " + name + "; allowed: real, manual, bytes");
}

Profile profile_of(const std::string& name) {
  if (name.empty() || name == "paper") return Profile::kPaper;
  if (name == "mark3") return Profile::kMark3;
  throw std::invalid_argument("compat: found " + name + "; allowed: paper, mark3");
}

Workcell workcell_for(const Robot& robot, const std::string& text) {
  return text.empty() ? empty_table(Reach(robot)) : load_workcell_of_either_form(text, "workcell");
}

recording::Header header_of_files(const Json& object) {
  const Robot robot = load_robot_of_either_form(object.at("robot").get<std::string>(), "robot");
  const Workcell workcell = workcell_for(robot, text_of(object, "workcell"));
  recording::Header header;
  header.cell = "main";
  header.mode = clock_of(text_of(object, "clock"));
  if (header.mode == ClockMode::kBytes) header.byte_clock = ByteClockSettings{};
  header.model =
      std::make_shared<const Model>(robot, workcell, profile_of(text_of(object, "compat")));
  if (const std::string text = text_of(object, "faults"); !text.empty())
    header.faults = load_faults(text, "faults", header.model->labels());
  return header;
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
  setup.header = recorded.empty() ? header_of_files(object) : header_of_recording(recorded);
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
