// Parts of the command line shared by the files that define the options; only those include this.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>

#include "cli/options/options.hpp"

namespace xr3 {

/// The largest limit of memory that a command accepts, MiB.
inline constexpr int kMaxMemoryMib = 1 << 20;

/// A CLI11 validator that calls the parser; the message of its std::invalid_argument is the error.
template <class Parse>
CLI::Validator parses(Parse parse) {
  return CLI::Validator(
      [parse](const std::string& text) -> std::string {
        try {
          parse(text);
          return {};
        } catch (const std::invalid_argument& error) {
          return error.what();
        }
      },
      "");
}

/// Adds an option with a value, which --help shows as `type`, such as FILE.
template <class Value>
CLI::Option* add_value(CLI::App& command, const std::string& name, Value& value,
                       const std::string& type, const std::string& what) {
  return command.add_option(name, value, what)->type_name(type);
}

/// Adds an option with a value that `parse` reads, which --help shows as `type`.
template <class Value, class Parse>
CLI::Option* add_parsed(CLI::App& command, const std::string& name, Value& value, Parse parse,
                        const std::string& type, const std::string& what) {
  const auto set = [&value, parse](const std::string& text) { value = parse(text); };
  return command.add_option_function<std::string>(name, set, what)
      ->type_name(type)
      ->check(parses(parse));
}

/// Adds the port of the preceding address, as a word of its own: `localhost 9600`. `set` may throw
/// std::invalid_argument.
void add_port_word(CLI::App& command, std::function<void(const std::string&)> set);

/// Validators: an empty text if the text is a valid address to listen on, port, or value of a flag;
/// else the error, with the allowed values.
std::string check_listen(const std::string& text);
std::string check_port(const std::string& text);
std::string check_flag(const std::string& text);

/// A validator of a number in [least, most]; its error prints the bounds without trailing zeros.
CLI::Validator number_between(double least, double most);
CLI::Validator whole_number_between(std::int64_t least, std::int64_t most);

/// Parses a profile. Throws std::invalid_argument, with the allowed values.
Profile parse_profile(const std::string& text);

/// Adds the option `--compat`.
void add_profile(CLI::App& command, Profile& profile);

/// Adds a flag. In the environment and in a config file it has a value, such as true.
void add_flag(CLI::App& command, const std::string& name, bool& value, const std::string& what);

/// Adds the options of `serve` that `exec` and `grade` have, too: robot, workcell and faults;
/// profile, clock, whose description is `clocks`, and turns of lines; the speed of lines.
void add_machine(CLI::App& command, ServeOptions& options);
void add_time(CLI::App& command, ServeOptions& options, const std::string& clocks);
void add_line_speed(CLI::App& command, ServeOptions& options);

/// Adds the options of `serve` that a replay with serving has, too: addresses and ports, the file
/// with the ports, the log, and access to the monitor port.
void add_ports(CLI::App& serve, ServeOptions& options);
void add_port_file(CLI::App& serve, ServeOptions& options);
void add_log(CLI::App& serve, ServeOptions& options);
void add_access(CLI::App& serve, ServeOptions& options);

/// Adds the subcommand `serve` with its options.
void add_serve(CLI::App& app, ServeOptions& options);

/// The options if they are consistent; else Leave with the error.
Options checked_serve(ServeOptions options);

}  // namespace xr3
