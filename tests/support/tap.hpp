// A serial line in memory with its wire records: input goes through the cell's SerialLine, and the
// records of both directions are formatted as a transcript.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cell/serial_line.hpp"
#include "core/simulation.hpp"
#include "protocol/explain/wire_record.hpp"

namespace xr3::test {

class Tap {
 public:
  explicit Tap(ModelPtr model);

  /// Sends bytes at the simulation's tick and returns the transcript of their records: a line `>
  /// bytes` for each input record, `< bytes` for each output record, and below it `from..to code:
  /// message` per item.
  std::string send(std::string_view bytes);

  Simulation& simulation() { return simulation_; }
  const std::vector<WireRecord>& records() const { return records_; }
  /// All bytes that the client has received.
  const std::string& received() const { return received_; }

 private:
  void receive(std::string_view bytes);

  Simulation simulation_;
  SerialLine line_;
  std::vector<Exchange> exchanges_;
  std::vector<WireRecord> records_;
  std::string received_;
};

/// A record in the format of send().
std::string transcript(const WireRecord& record, const Model& model);

}  // namespace xr3::test
