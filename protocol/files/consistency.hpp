// The rules of data files that concern more than one member. They check the parts that were read
// without errors, and report to the reading.
#pragma once

#include <string>
#include <string_view>

#include "core/coupling.hpp"
#include "core/faults/fault.hpp"
#include "core/model.hpp"
#include "protocol/json/codec.hpp"

namespace xr3 {

/// Distinct labels, names and masks, homes and switches within limits, references to existing
/// joints, and both homes outside the protected region.
void check_robot(const Robot& robot, data::Reading& reading);

/// Positions at the hard home: every motor at its microswitch, coupling included (paper,
/// Section III-A).
Positions hard_home(const Model& model);

/// Errors: duplicate names, a camera that is not above the work surface or is reached by a block.
/// Warnings: blocks that overlap, float, lie below the work surface or outside the workspace, are
/// too wide for the robot's tool or out of its reach. `robot` may be nullptr. The reach is checked
/// for the blocks from index `first_reach` on; if the robot's inverse kinematics has no closed
/// form, for 100 of them.
void check_workcell(const Workcell& workcell, const Robot* robot, std::size_t first_reach,
                    data::Reading& reading);

/// Maximum opening of the robot's jaws, in mm.
double widest_opening_mm(const Robot& robot);

/// Checks a fault, which was read from the object at `pointer`: which members its kind has, one
/// trigger, one duration at most. `labels`: those of the robot's motors; empty if the robot is not
/// known.
void check_fault(const Fault& fault, const std::string& pointer, std::string_view labels,
                 data::Reading& reading);

/// Checks the faults at /faults/0... of the document, and that their names differ.
void check_faults(const FaultPlan& plan, std::string_view labels, data::Reading& reading);

}  // namespace xr3
