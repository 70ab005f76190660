// The cells that `xr3 serve` opens at the start, as its options say: --cells, --cell, --roster,
// --robot-port.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace xr3 {

struct ServeOptions;

inline constexpr std::size_t kMaxCellName = 32;
/// Whether the name has 1 to kMaxCellName characters, all of A-Z, a-z, 0-9, _ and -.
bool is_cell_name(std::string_view name);

/// One `--cell NAME=ROBOT[,WORKCELL[,PORT]]`, or row of a roster (roster.hpp).
struct CellChoice {
  std::string name;
  std::string robot;                  ///< name or path; empty for that of --robot
  std::string workcell;               ///< name or path; empty for the one with the robot's name
  std::optional<std::uint16_t> port;  ///< 0 for any free port; nullopt for that of its place
  std::string token_file = {};        ///< with --private: file with its token; empty for none
  std::string source = {};            ///< file and line of the roster; empty for --cell
  bool operator==(const CellChoice&) const = default;
};

/// Parses the text of --cell. Throws std::invalid_argument, with the allowed form.
CellChoice parse_cell(const std::string& text);

/// A cell to open at the start.
struct CellPlan {
  std::string name;
  std::string robot;       ///< name or path
  std::string workcell;    ///< name or path; empty for the one with the robot's name
  std::uint16_t port = 0;  ///< 0 for any free port
  std::string token_file = {};
  std::string token = {};  ///< empty until assign_tokens(), and if it has none
  bool operator==(const CellPlan&) const = default;
};

/// The options contradict each other.
class CellPlanError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The first robot port of several cells: that of cell k is 9700 + k.
inline constexpr std::uint16_t kFirstOfManyPorts = 9701;

/// The cells, in order: one named `main` without --cells, --cell and --roster; with
/// --cell-per-connection those of the roster, at port 0. Throws CellPlanError.
std::vector<CellPlan> plan_cells(const ServeOptions& options);

}  // namespace xr3
