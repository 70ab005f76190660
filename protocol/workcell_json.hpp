// The workcell's data file (paper, Section III-B) as text to value and back. The text comes from the
// caller: nothing here reads a file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "protocol/finding.hpp"
#include "protocol/json_source.hpp"

namespace xr3 {

/// A workcell, unless a finding is an error, and everything found in its file, sorted by line.
struct WorkcellReading {
  std::optional<Workcell> workcell;
  Findings findings;
};

/// Reads and checks a workcell file; given a robot, also whether its tool can take the blocks. Syntax
/// errors are findings like all others: it never throws.
WorkcellReading read_workcell(std::string_view text, const std::string& file,
                              const Robot* robot = nullptr);

/// The workcell in a file's text. Throws DataError with every finding if one of them is an error.
Workcell load_workcell(std::string_view text, const std::string& file);

/// The file form in mm, its members in the documented order. Loaded again it gives an equal workcell.
Json workcell_to_json(const Workcell& workcell);

}  // namespace xr3
