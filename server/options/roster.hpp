// The file of `--roster`: the names of a class, each with a robot. A table (CSV) whose header names
// the columns, as spreadsheets write it, or a list of objects (JSON) with members of these names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/json/finding.hpp"
#include "server/options/cells.hpp"

namespace xr3 {

/// Reads the text of a roster; findings have its lines. Never throws. Columns: name, and optionally
/// robot, workcell, port and token_file. Commas, semicolons or tabs separate the fields of a table;
/// quotes may enclose them. Each cell has a name of its own.
FileReading<std::vector<CellChoice>> read_roster(std::string_view text, const std::string& file);

/// Reads the file. Throws FileError and DataError.
std::vector<CellChoice> load_roster(const std::string& path);

}  // namespace xr3
