#include "protocol/line/rhino_endpoint.hpp"

#include <cassert>

#include "protocol/line/rhino_reply.hpp"

namespace xr3 {

void RhinoEndpoint::feed(std::uint8_t byte, std::uint64_t offset, Simulation& simulation,
                         std::string& replies, std::vector<Exchange>& exchanges) {
  assert(simulation.events().empty());
  for (const Parsed& item : parse(byte, offset, simulation.state().enabled))
    execute(item, simulation, replies, exchanges);
}

const std::vector<Parsed>& RhinoEndpoint::parse(std::uint8_t byte, std::uint64_t offset,
                                                bool enabled) {
  parsed_.clear();
  if (enabled) {
    parser_.feed(byte, offset, parsed_);
  } else {
    parser_.feed_disabled(byte, offset, parsed_);
  }
  return parsed_;
}

void RhinoEndpoint::execute(const Parsed& item, Simulation& simulation, std::string& replies,
                            std::vector<Exchange>& exchanges) const {
  Exchange& exchange = exchanges.emplace_back(item);
  const Command* command = std::get_if<Command>(&exchange.parsed.what);
  if (command == nullptr) return;
  exchange.reply = simulation.execute(*command);
  append_reply(exchange.reply, profile_, replies);
  if (!simulation.events().empty()) exchange.events = simulation.take_events();
}

}  // namespace xr3
