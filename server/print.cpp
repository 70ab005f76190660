#include "server/print.hpp"

#include <iostream>

#include "protocol/text/printable.hpp"

namespace xr3 {

void print_text(std::string_view lines) { std::cout << printable_lines(lines) << std::flush; }

void print_json(std::string_view json) { std::cout << printable_json(json) << std::flush; }

void print_error(std::string_view lines) { std::cerr << printable_lines(lines); }

}  // namespace xr3
