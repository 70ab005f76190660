// Models for tests: the robots of data/ as the loader reads them, roomier versions of them, and
// arms that exist nowhere but here. Every model is built once and shared.
#pragma once

#include <string>
#include <string_view>

#include "core/model.hpp"

namespace xr3::test {

/// The text of a file of the checkout, as in "data/robots/rhino-xr3.json". Throws if there is none.
std::string project_file(std::string_view path);

/// data/robots/NAME.json.
const Robot& robot_named(std::string_view name);
/// data/workcells/NAME.json.
const Workcell& workcell_named(std::string_view name);

/// An empty table at z = 0, without camera.
Workcell bare_workcell();

/// The Rhino XR-3 on a bare table.
ModelPtr rhino(Profile profile = Profile::kPaper);

/// The Rhino hung up in empty space: no protected region, and a work surface out of reach, so that
/// nothing but its limits stops it.
ModelPtr roomy_rhino(Profile profile = Profile::kPaper);

/// A model of this robot on a bare table.
ModelPtr model_of(Robot robot, Profile profile = Profile::kPaper);

/// An arm of 1...7 joints with irregular links, turning and sliding by turns, that nothing stops.
Robot odd_arm(int joints);

}  // namespace xr3::test
