// The tokens of the cells of `--roster` with `--private`, which outlast the server: they are kept
// beside the roster, in FILE.tokens, a JSON object from names to tokens.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "server/options/cells.hpp"

namespace xr3 {

struct ServeOptions;

/// By the name of the cell.
using CellTokens = std::map<std::string, std::string>;

/// Reads such a file; empty if there is none. Throws FileError, also if other users of this machine
/// may read it, and for anything but names with tokens.
CellTokens read_cell_tokens(const std::string& path);

/// Gives each cell its token: that of its token_file, that in FILE.tokens, or a new one, which is
/// added there. The tokens of other names stay. No effect unless the options have --private and
/// several cells; without a roster each token is new. Throws FileError and TokenError.
void assign_tokens(const ServeOptions& options, std::vector<CellPlan>& plans);

}  // namespace xr3
