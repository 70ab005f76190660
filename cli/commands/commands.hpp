// The commands of xr3 apart from `serve`. Each executes the options of its command line, and
// returns the exit code. All throw FileError or DataError if a file cannot be read, used or
// written.
//
// The flow through the folder: main.cpp passes the variant of parse_options()
// (cli/options/options.hpp) to the run_command() of its type; each command has a source of its own.
// Commands on files read them with server/files/data_files.hpp, load them with protocol/files and
// print with server/print.hpp: check, convert, draw, export, kin and workcell, whose text comes
// from tools. replay repeats a recording on a fresh cell, and can then serve from its end with App.
// exec, grade and exercise run programs through cli/exec. watch connects to a monitor port
// (watch_connection.hpp), keeps a model of the cell (tools/watch/model.hpp) and shows it with
// ncurses (terminal.hpp); term is in cli/term; healthcheck makes one short connection. manual
// prints cli/manual. Errors of a command end it by an exception, which main.cpp prints as one
// sentence, or by fail() (fail.hpp).
#pragma once

#include "cli/options/options.hpp"
#include "server/base/exit_code.hpp"

namespace xr3 {

/// `xr3 check FILE...`: findings go to standard error, summaries of the files to standard output.
/// kBadInput if a file has an error.
ExitCode run_command(const CheckOptions& options);

/// `xr3 draw OUT`: writes the wire frame of a robot and its workcell; SVG if the name ends in .svg,
/// else PNG. Throws ArgumentError.
ExitCode run_command(const DrawOptions& options);

/// `xr3 kin`: writes the kinematics of a robot to standard output. kBadInput, with a sentence on
/// standard error, if the options are invalid or the pose is unreachable; --json writes the report
/// in the latter case, too.
ExitCode run_command(const KinOptions& options);

/// `xr3 convert IN OUT`: the content of IN determines its form; the extension of OUT determines the
/// new one: .json, or .txt or .dat for the paper's plain form; .mcap if IN is a recording
/// (convert_recording.hpp). Findings in IN go to standard error. kBadInput if IN has an error, if
/// OUT has another extension, or if OUT exists and `force` is not set.
ExitCode run_command(const ConvertOptions& options);

/// `xr3 export --urdf|--mjcf ROBOT`: writes the robot and its meshes into a folder. kBadInput if
/// the robot's file exists there and `force` is not set.
ExitCode run_command(const ExportOptions& options);

/// `xr3 workcell NEW.json`: the workcell editor. kBadInput if the input ends, or a signal (such as
/// Ctrl-C) interrupts it, with unsaved changes.
ExitCode run_command(const WorkcellOptions& options);

/// `xr3 watch`: shows a robot in the terminal, through the monitor port, until a key or a signal
/// ends it. Reconnects automatically. With --once, or if standard output is not a terminal, prints
/// one screen as text: kNoServer, with a sentence on standard error, if no server answers within a
/// few seconds; kBadInput if the server refuses the request. Throws TokenError for --token-file.
ExitCode run_command(const WatchOptions& options);

/// `xr3 term`: runs until the user quits, or, if standard input or output is no terminal, until
/// standard input has ended and is answered. kNoServer, with a sentence, if the peer is lost, or
/// leaves an inquiry of a script unanswered. Throws ExitError if the line cannot be opened.
ExitCode run_command(const TermOptions& options);

/// `xr3 healthcheck`: checks whether a server answers on this machine, for up to `wait_s`.
/// kNoServer if no healthy xr3 server answers, kBadInput if the port file is invalid, with a
/// sentence on standard error.
ExitCode run_command(const HealthOptions& options);

/// `xr3 replay`: repeats a recording, compares, and shows the end, or serves from it on. kDifferent
/// if something differs; nothing is served then.
ExitCode run_command(const ReplayCommand& command);

/// `xr3 exec`: runs a program against fresh robots, judges the runs, and reports. kTimeUp before
/// kProgramFailed before kDifferent before kGoalsMissed. Throws std::system_error.
ExitCode run_command(const ExecCommand& command);

/// `xr3 grade`: runs every submission of a class, and writes a report with a page. kGood when every
/// submission was run, whatever its points. Throws std::system_error.
ExitCode run_command(const GradeCommand& command);

/// `xr3 exercise check`: proves an exercise, with a line for each of its programs. kBadInput if one
/// does not get its expected verdict. Throws std::system_error.
ExitCode run_command(const ExerciseOptions& options);

/// `xr3 manual --write FOLDER`: writes the files, over those of the same names, and prints their
/// number.
ExitCode run_command(const ManualFiles& manual);

}  // namespace xr3
