// The wire records of a serial line in memory, of both directions, formatted as a transcript.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/simulation.hpp"
#include "protocol/explain/wire_record.hpp"
#include "tests/support/one_line.hpp"

namespace xr3::test {

class Tap {
 public:
  explicit Tap(ModelPtr model) : one_(std::move(model)) {}

  /// Sends bytes at the simulation's tick and returns the transcript of their records: a line `>
  /// bytes` for each input record, `< bytes` for each output record, and below it `from..to code:
  /// message` per item.
  std::string send(std::string_view bytes);

  Simulation& simulation() { return one_.cell.machine; }
  const std::vector<WireRecord>& records() const { return records_; }
  /// All bytes that the client has received.
  const std::string& received() const { return received_; }

 private:
  void receive(std::string_view bytes);

  OneLine one_;
  std::vector<WireRecord> records_;
  std::string received_;
};

/// A record in the format of send().
std::string transcript(const WireRecord& record, const Model& model);

}  // namespace xr3::test
