// The digest of all that a cell's future depends on, beside its inputs: the machine, the clock and
// the lines with their parsers and queues. Equal on every machine.
#pragma once

#include <string>

#include "cell/cell.hpp"

namespace xr3 {

class StateHasher {
 public:
  /// `sha256:` and 64 hexadecimal digits.
  std::string hash(const Cell& cell);

 private:
  ModelPtr model_;  ///< of the last call
  std::string model_hash_;
};

}  // namespace xr3
