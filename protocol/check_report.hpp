// What `xr3 check` says about a data file: which kind it is, everything found in it, and a summary for
// people. The caller reads the file, prints and chooses the exit code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/model.hpp"
#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "protocol/finding.hpp"

namespace xr3 {

enum class DataKind : std::uint8_t { kUnknown, kRobot, kWorkcell };

/// The findings, and, if none of them is an error, the value and its summary.
struct CheckResult {
  DataKind kind = DataKind::kUnknown;
  Findings findings;    ///< sorted by line; print each with to_text
  std::string summary;  ///< lines, each ended by a line feed; empty if there are errors
  std::optional<Robot> robot;
  std::optional<Workcell> workcell;

  bool is_good() const { return !has_errors(findings); }
};

/// Checks one file's text: a file with `joints` is a robot, one with `workspace` or `blocks` a
/// workcell. The profile gives switches the width they have under it. Given a robot, a workcell is
/// checked against its tool as well. Never throws.
CheckResult check_text(std::string_view text, const std::string& file, Profile profile,
                       const Robot* robot = nullptr);

/// D-H table, motors, coupling, region, net roll and both homes (paper, Table II and Section III-A).
std::string robot_summary(const Robot& robot, Profile profile);

/// Workspace, blocks and camera (paper, Section III-B).
std::string workcell_summary(const Workcell& workcell);

}  // namespace xr3
