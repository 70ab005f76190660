// The setup of a robot in a page, as one JSON object with the contents of its files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/goals/goal.hpp"
#include "protocol/recording/header.hpp"

namespace xr3 {

struct PageSetup {
  std::string product;       ///< name and version of the program, such as `xr3 0.10.0`
  recording::Header header;  ///< of the robot's recording, without the product
  GoalList goals;
  std::optional<std::uint64_t> seed;  ///< of a variation of the blocks
};

/// Reads an object with the members `product`, `robot`, `workcell`?, `faults`?, `goals`?, `clock`?
/// ("real", "manual", "bytes" or "bytes:INQUIRY_MS"; default "real"), `vary`? (a variation of the
/// blocks, as `xr3 exec --vary` takes it) and `compat`? ("paper" or "mark3"; default "paper"). The
/// second to the fifth are contents of files, robot and workcell in either form; without a workcell
/// the table is empty. Instead of all but `product` and `goals` it may have `recording`, which is a
/// recording, or the first line of one, of a robot without a physical controller. Throws DataError
/// with all findings in a file, each of which names the file by the member, and
/// std::invalid_argument if another member or the object itself is wrong.
PageSetup read_setup(std::string_view json);

}  // namespace xr3
