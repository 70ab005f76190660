#include "tests/support/wire.hpp"

#include <utility>
#include <variant>

#include "protocol/explain/diagnostic.hpp"

namespace xr3::test {

void Wire::send(std::string_view bytes, Simulation& simulation) {
  std::swap(one_.cell.machine, simulation);  // it is lent to the line
  while (!bytes.empty() && !is_closed()) {
    const std::size_t taken = one_.receive(bytes);
    exchanges_.insert(exchanges_.end(), one_.exchanges().begin(), one_.exchanges().end());
    bytes.remove_prefix(taken);
    if (taken == 0) break;
  }
  std::swap(one_.cell.machine, simulation);
}

std::vector<std::string> Wire::problems() const {
  std::vector<std::string> codes;
  for (const Exchange& exchange : exchanges_) {
    const Problem* problem = std::get_if<Problem>(&exchange.parsed.what);
    if (problem != nullptr) codes.emplace_back(code_of(problem->code));
  }
  return codes;
}

}  // namespace xr3::test
