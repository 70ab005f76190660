// A tapped line in memory: what a client sends goes through the server's own Line, and what the wire
// records say of it, in and out, is kept and can be read as a transcript.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/simulation.hpp"
#include "protocol/wire_record.hpp"
#include "server/line.hpp"

namespace xr3::test {

class Tap {
 public:
  explicit Tap(ModelPtr model);

  /// Sends bytes at the simulation's tick and returns what was told of them: a line `> bytes` for each
  /// record in, `< bytes` for each out, under each a line `from..to code: message` for each item.
  std::string send(std::string_view bytes);

  Simulation& simulation() { return simulation_; }
  const std::vector<WireRecord>& records() const { return records_; }
  /// Everything that the client has received.
  const std::string& received() const { return received_; }

 private:
  void receive(std::string_view bytes);

  Simulation simulation_;
  Line line_;
  std::vector<Exchange> exchanges_;
  std::vector<WireRecord> records_;
  std::string received_;
};

/// A record as send() shows it.
std::string transcript(const WireRecord& record, const Model& model);

}  // namespace xr3::test
