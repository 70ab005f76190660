// The report about the submissions of a class: a page and a table.
#pragma once

#include <string>
#include <vector>

#include "tools/report/run_report.hpp"

namespace xr3 {

/// A page with a table of all submissions, and for each its goals, the picture of the end and links
/// to its files, which are in the folder with its name beside the page.
std::string to_html(const std::vector<RunReport>& reports);

/// Lines with name, outcome, points, maximum, simulated seconds, bytes, and the goals that were
/// missed.
std::string to_csv(const std::vector<RunReport>& reports);

}  // namespace xr3
