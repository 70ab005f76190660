// What a robot in a page is made of: the contents of its files, as one JSON object.
#pragma once

#include <cstdint>
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
  ByteClockSettings bytes;            ///< with ClockMode::kBytes
  std::optional<std::uint64_t> seed;  ///< of a variation of the blocks
};

/// Reads an object with the members `product`, `robot`, `workcell`?, `faults`?, `goals`?, `clock`?
/// ("real", "manual", "bytes" or "bytes:INQUIRY_MS"; default "real"), `vary`? (a variation of the
/// blocks, as `xr3 exec --vary` takes it) and `compat`? ("paper" or "mark3"; default "paper"). The
/// second to the fifth are contents of files, robot and workcell in either form; without a workcell
/// the table is empty. Throws DataError with all findings in a file, each of which names the file
/// by the member, and std::invalid_argument if another member or the object itself is wrong.
PageSetup read_setup(std::string_view json);

}  // namespace xr3
