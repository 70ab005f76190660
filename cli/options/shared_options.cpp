#include "cli/options/shared_options.hpp"

#include <cstdint>
#include <stdexcept>
#include <utility>

#include "protocol/text/text_stream.hpp"
#include "protocol/text/whole_number.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

void add_port_word(CLI::App& command, std::function<void(const std::string&)> set) {
  const auto checked = [set = std::move(set)](const std::string& text) {
    try {
      set(text);
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError(error.what());
    }
  };
  command.add_option_function<std::string>("port", checked, "the port, as a word of its own")
      ->type_name("PORT");
}

std::string check_listen(const std::string& text) {
  ErrorCode error;
  if (text != "localhost") asio::ip::make_address(text, error);
  return error ? text + " is not an address; give one such as 127.0.0.1 or ::1" : "";
}

std::string check_port(const std::string& text) {
  return whole_number<std::uint16_t>(text, 0, 65535)
             ? ""
             : text + ": a port is a number from 0 to 65535";
}

std::string check_flag(const std::string& text) {
  const std::string word = CLI::detail::to_lower(text);
  for (const char* known : {"true", "false", "1", "0", "yes", "no", "on", "off"})
    if (word == known) return {};
  return text + ": a flag is true or false, 1 or 0, yes or no, on or off";
}

CLI::Validator number_between(double least, double most) {
  return CLI::Validator(
      [least, most](const std::string& text) -> std::string {
        double number = 0;
        const bool is_number = CLI::detail::lexical_cast(text, number);
        if (is_number && number >= least && number <= most) return {};
        TextStream allowed;
        allowed << text << ": a number from " << least << " to " << most;
        return allowed.str();
      },
      "");
}

CLI::Validator whole_number_between(std::int64_t least, std::int64_t most) {
  return CLI::Validator(
      [least, most](const std::string& text) -> std::string {
        if (whole_number(text, least, most)) return {};
        return text + ": a whole number from " + std::to_string(least) + " to " +
               std::to_string(most);
      },
      "");
}

Profile parse_profile(const std::string& text) {
  const std::string word = CLI::detail::to_lower(text);
  if (word == "paper") return Profile::kPaper;
  if (word == "mark3") return Profile::kMark3;
  throw std::invalid_argument(text + ": a controller is paper or mark3");
}

void add_profile(CLI::App& command, Profile& profile) {
  add_parsed(command, "--compat", profile, parse_profile, "paper|mark3",
             "controller to simulate: paper (default), or mark3 (the hardware)");
}

void add_flag(CLI::App& command, const std::string& name, bool& value, const std::string& what) {
  command.add_flag(name, value, what)->check(CLI::Validator(check_flag, ""));
}

}  // namespace xr3
