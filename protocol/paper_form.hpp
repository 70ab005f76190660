// The paper's own data files: plain numbers in the order of its Section III, one item or one row a
// line, with comment lines that begin with `*`. What our JSON files have beyond the paper's stands in
// comment lines that begin with `*+`, so that nothing is lost on the way there and back. The form is
// described in docs/paper-form.md. The text comes from the caller: nothing here reads a file.
#pragma once

#include <string>
#include <string_view>

#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "protocol/check_report.hpp"
#include "protocol/robot_json.hpp"
#include "protocol/workcell_json.hpp"

namespace xr3 {

/// The plain form in mm, a comment line above every item. Read again it gives an equal robot.
std::string robot_to_paper_form(const Robot& robot);
std::string workcell_to_paper_form(const Workcell& workcell);

/// Reads and checks a file of the plain form as read_robot does with JSON; the pointers of findings are
/// those of the JSON form. Never throws.
RobotReading read_paper_robot(std::string_view text, const std::string& file);
/// The same for a workcell; `robot` as in read_workcell.
WorkcellReading read_paper_workcell(std::string_view text, const std::string& file,
                                    const Robot* robot = nullptr);

/// Whether a text is JSON, broken or not: its first character outside comments opens an object or list.
bool is_json_form(std::string_view text);

/// check_text, for files of either form. A plain file that begins with one number is a robot, one with
/// three a workcell. What is called .json and does not begin with a number is JSON, broken or not.
CheckResult check_either_form(std::string_view text, const std::string& file, Profile profile,
                              const Robot* robot = nullptr);

/// load_robot and load_workcell, for files of either form. Throw DataError with every finding if one of
/// them is an error, or if a plain file is of the other kind.
Robot load_robot_of_either_form(std::string_view text, const std::string& file);
Workcell load_workcell_of_either_form(std::string_view text, const std::string& file);

}  // namespace xr3
