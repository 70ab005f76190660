// The log, on standard error or in a file. It never blocks: messages are dropped while a pipe is
// full, and beyond a budget, see log_budget.hpp. Messages of level critical are never dropped for
// the budget.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/model.hpp"
#include "protocol/explain/cell_event.hpp"

namespace xr3 {

/// Rotation of a log file: FILE, FILE.1 ... up to this number of files of this size.
inline constexpr std::size_t kMaxLogFileBytes = std::size_t{10} * 1024 * 1024;
inline constexpr std::size_t kMaxLogFiles = 5;

/// Makes spdlog's default logger write from `level` up (trace, debug, ... off) to a file, or to
/// standard error if `file` is empty. Throws FileError if the file cannot be opened.
void start_log(const std::string& level, const std::string& file);

/// Names that messages about a cell contain.
struct LogNames {
  std::string_view cell;  ///< name of the cell; empty if it is the only one
  std::string_view page;  ///< address of the page on the monitor port; empty if there is none
};

/// Logs an event of a cell: the machine's events at debug, except stalls and warnings; the end of a
/// recording as a warning; all others at info.
void log_event(const CellEvent& event, const Model& model, const LogNames& names = {});

/// A hint for the user of a browser that has connected to a robot port.
std::string browser_hint(std::string_view page);

}  // namespace xr3
