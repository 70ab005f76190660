#include "protocol/line/rhino_endpoint.hpp"

#include <cassert>

#include "protocol/line/rhino_reply.hpp"

namespace xr3 {

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
  assert(simulation.events().empty());
  Exchange& exchange = exchanges.emplace_back(item);
  const Command* command = std::get_if<Command>(&exchange.parsed.what);
  if (command == nullptr) return;
  exchange.reply = simulation.execute(*command);
  append_reply(exchange.reply, profile_, replies);
  if (!simulation.events().empty()) exchange.events = simulation.take_events();
}

}  // namespace xr3
