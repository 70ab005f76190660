#include "tests/support/wire.hpp"

#include <variant>

#include "protocol/explain/diagnostic.hpp"

namespace xr3::test {

void Wire::send(std::string_view bytes, Simulation& simulation) {
  simulation.take_events();
  line_.receive(bytes, simulation, exchanges_);
}

std::string Wire::received() {
  std::string bytes(line_.outbox());
  line_.sent(bytes.size(), 0);
  return bytes;
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
