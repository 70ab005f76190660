// Models for tests: the robots of data/, variants without obstacles, and fictitious arms. Every
// model is built once and shared.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/model.hpp"

namespace xr3::test {

/// The text of a file of the checkout, such as "data/robots/rhino-xr3.json". Throws if there is
/// none.
std::string project_file(std::string_view path);

/// The names of the robots in data/robots.
inline const std::vector<std::string> kShippedRobots = {"rhino-xr3", "adept-one", "intelledex-660",
                                                        "rhino-xr3-accessories"};

/// data/robots/NAME.json.
const Robot& robot_named(std::string_view name);
/// data/workcells/NAME.json.
const Workcell& workcell_named(std::string_view name);

/// An empty table at z = 0, without camera.
Workcell bare_workcell();

/// The Rhino XR-3 on a bare table.
ModelPtr rhino(Profile profile = Profile::kPaper);

/// The Rhino without a protected region and with the work surface out of reach: only its limits
/// stop it.
ModelPtr roomy_rhino(Profile profile = Profile::kPaper);

/// A model of this robot on a bare table.
ModelPtr model_of(Robot robot, Profile profile = Profile::kPaper);

/// The robot on a slide G along y, home in the middle of 500 mm, half a millimetre a count.
Robot on_slide(Robot robot);

/// An arm of 1...7 joints with irregular links, alternately revolute and prismatic, without
/// obstacles.
Robot odd_arm(int joints);

}  // namespace xr3::test
