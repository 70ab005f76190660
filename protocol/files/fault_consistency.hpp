// The rules of fault files that concern more than one member: which members a kind has, one trigger
// for each fault, one duration at most, names that differ, joints that the robot has.
#pragma once

#include <string>
#include <string_view>

#include "core/faults/fault.hpp"
#include "protocol/json/codec.hpp"

namespace xr3 {

/// Checks a fault, which was read from the object at `pointer`. `labels`: those of the robot's
/// motors; empty if the robot is not known.
void check_fault(const Fault& fault, const std::string& pointer, std::string_view labels,
                 data::Reading& reading);

/// Checks the faults at /faults and /faults/0... of the document.
void check_faults(const FaultPlan& plan, std::string_view labels, data::Reading& reading);

}  // namespace xr3
