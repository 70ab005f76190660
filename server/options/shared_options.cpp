#include "server/options/shared_options.hpp"

#include <charconv>
#include <cstdint>
#include <sstream>
#include <stdexcept>

#include "server/net/asio.hpp"

namespace xr3 {

std::string check_listen(const std::string& text) {
  ErrorCode error;
  if (text != "localhost") asio::ip::make_address(text, error);
  return error ? text + " is not an address; give one such as 127.0.0.1 or ::1" : "";
}

std::string check_port(const std::string& text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  const bool is_port = error == std::errc{} && end == text.data() + text.size();
  return is_port ? "" : text + ": a port is a number from 0 to 65535";
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
        std::ostringstream allowed;
        allowed << text << ": a number from " << least << " to " << most;
        return allowed.str();
      },
      "");
}

CLI::Validator whole_number_between(std::int64_t least, std::int64_t most) {
  return CLI::Validator(
      [least, most](const std::string& text) -> std::string {
        std::int64_t number = 0;
        const char* const end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data(), end, number);
        const bool is_whole = error == std::errc() && rest == end;
        if (is_whole && number >= least && number <= most) return {};
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
  command
      .add_option_function<std::string>(
          "--compat", [&profile](const std::string& text) { profile = parse_profile(text); },
          "controller to simulate: paper (default), or mark3 (the hardware)")
      ->type_name("paper|mark3")
      ->check(parses(parse_profile, ""));
}

void add_flag(CLI::App& command, const std::string& name, bool& value, const std::string& what) {
  command.add_flag(name, value, what)->check(CLI::Validator(check_flag, ""));
}

}  // namespace xr3
