#include "protocol/line/device_command.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "protocol/line/rhino_parser.hpp"

namespace xr3 {
namespace {

/// The commands of these bytes as a device gets them, each behind `?` if it is an inquiry; `-` for
/// one that only the simulator has.
std::string sent_for(std::string_view bytes) {
  RhinoParser parser(Profile::kMark3);
  std::vector<Parsed> parsed;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    parser.feed(static_cast<std::uint8_t>(bytes[i]), i, parsed);
  std::string all;
  for (const Parsed& each : parsed) {
    const auto* command = std::get_if<Command>(&each.what);
    if (command == nullptr) continue;
    const auto encoded = for_device(*command);
    all += encoded ? (encoded->is_inquiry ? "<" + encoded->bytes + ">" : encoded->bytes) : "-";
  }
  return all;
}

TEST(DeviceCommand, AMoveNamesItsJointAndEndsWithAReturn) {
  EXPECT_EQ(sent_for("E+50\rE-7F3+0\r"), "E+50\rE-7\rF+3\rF+0\r");
}

TEST(DeviceCommand, InquiriesOfAMark3) { EXPECT_EQ(sent_for("E?IJKf?"), "<E?><I><J><K><F?>"); }

TEST(DeviceCommand, OtherCommandsOfAMark3) {
  EXPECT_EQ(sent_for("EXLMNOP3R8Q"), "EXLMNOP3\rR8\rQ");
}

TEST(DeviceCommand, OnlyTheSimulatorHasTheRest) {
  EXPECT_EQ(sent_for("ET"), "-");
  EXPECT_EQ(sent_for("EV"), "-");
  EXPECT_EQ(sent_for("E100S"), "-");
  for (const char* environment : {"A#", "A!1,1,1!", "A$", "A@", "A.4\r", "A|", "A%3"})
    EXPECT_EQ(sent_for(environment), "-") << environment;
  for (const char* camera : {"A**", "A*3*", "A*1,2*"}) EXPECT_EQ(sent_for(camera), "-") << camera;
}

TEST(DeviceCommand, StopsEveryJoint) { EXPECT_EQ(stop_all_joints(), "AXBXCXDXEXFXGXHX"); }

}  // namespace
}  // namespace xr3
