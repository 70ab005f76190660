// Parts of the command line that several of its files are made of. Only options*.cpp include this.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>

#include "server/options.hpp"

namespace xr3 {

/// A CLI11 check: the text parses, or the parser's words say why not.
template <class Parse>
CLI::Validator parses(Parse parse, const std::string& what) {
  return CLI::Validator(
      [parse](const std::string& text) -> std::string {
        try {
          parse(text);
          return {};
        } catch (const std::invalid_argument& error) {
          return error.what();
        }
      },
      what);
}

/// Checks that say what is allowed: an address to listen on, a port, and a flag that is not an argument.
std::string check_listen(const std::string& text);
std::string check_port(const std::string& text);
std::string check_flag(const std::string& text);

/// A check of a number, which says the bounds as people write them.
CLI::Validator number_between(double least, double most);

/// Throws std::invalid_argument with what is allowed.
Profile parse_profile(const std::string& text);

/// `--compat`, for whatever sees lines.
void add_profile(CLI::App& command, Profile& profile);

/// A flag: there, or not there; elsewhere than on the command line it has a value.
void add_flag(CLI::App& command, const std::string& name, bool& value, const std::string& what);

/// The subcommand `serve` with its options.
void add_serve(CLI::App& app, ServeOptions& options);

/// What `serve` was told, completed by the environment; or why it makes no sense together.
Options checked_serve(ServeOptions options);

}  // namespace xr3
