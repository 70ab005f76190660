// The paper's own data files ("plain form"): numbers in the order of the paper's Section III, one
// item or one row per line, with comment lines that begin with `*`. Members of the JSON files that
// the paper's form lacks are in comment lines that begin with `*+`, so that conversion in both
// directions is lossless. docs/paper-form.md describes the form. The text comes from the caller; no
// file is read here.
//
// The flow through the folder: to read, lines.hpp splits the text into data lines and additions,
// and PaperReader (reader.hpp) follows a table of rows, fills the JSON of the same data file and
// records the line of each value. Then the JSON loader (protocol/files/robot.hpp, workcell.hpp)
// checks the values, and the reader gives its findings the line numbers of the plain file. To
// write, writer.hpp takes the JSON of the file and follows the same tables. The tables are in
// robot.cpp and workcell.cpp: they name each row, its members and the words that its numbers stand
// for.
#pragma once

#include <string>
#include <string_view>

#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "protocol/check/check_report.hpp"
#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"

namespace xr3 {

/// The plain form in mm, with a comment line above every item. Reading it gives an equal robot.
std::string robot_to_paper_form(const Robot& robot);
std::string workcell_to_paper_form(const Workcell& workcell);

/// Reads and checks a file in plain form, like read_robot() for JSON. Findings have the pointers of
/// the JSON form. Never throws.
FileReading<Robot> read_paper_robot(std::string_view text, const std::string& file);
/// Reads and checks a workcell in plain form, like read_workcell() for JSON; `robot` as there.
/// Never throws.
FileReading<Workcell> read_paper_workcell(std::string_view text, const std::string& file,
                                          const Robot* robot = nullptr);

/// Whether a text is meant as JSON, valid or not: its first character outside comments starts an
/// object or a list, or it is UTF-16, which the reader of JSON refuses.
bool is_json_form(std::string_view text);

/// check_text() for files of either form. A plain file whose first line has one number is a robot,
/// with three numbers a workcell. A file named .json that does not begin with a number is read as
/// JSON.
CheckResult check_either_form(std::string_view text, const std::string& file, Profile profile,
                              const Robot* robot = nullptr);

/// load_robot() and load_workcell() for files of either form. Throw DataError with all findings if
/// one is an error, or if a plain file is of the other kind.
Robot load_robot_of_either_form(std::string_view text, const std::string& file);
Workcell load_workcell_of_either_form(std::string_view text, const std::string& file);

}  // namespace xr3
