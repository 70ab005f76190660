// What a robot in a page is made of: the contents of its files, as one JSON object.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cell/byte_clock.hpp"
#include "core/faults/fault.hpp"
#include "core/model.hpp"
#include "core/sim_clock.hpp"
#include "protocol/goals/goal.hpp"

namespace xr3 {

struct PageSetup {
  std::string product;  ///< name and version of the program, such as `xr3 0.7.0`
  ModelPtr model;
  std::optional<FaultPlan> faults;
  GoalList goals;
  ClockMode clock = ClockMode::kReal;
};

/// Reads an object with the members `product`, `robot`, `workcell`?, `faults`?, `goals`?, `clock`?
/// ("real", "manual" or "bytes"; default "real") and `compat`? ("paper" or "mark3"; default
/// "paper"). The second to the fifth are contents of files, robot and workcell in either form;
/// without a workcell the table is empty. Throws DataError with all findings in a file, each of
/// which names the file by the member, and std::invalid_argument if the object itself is wrong.
PageSetup read_setup(std::string_view json);

}  // namespace xr3
