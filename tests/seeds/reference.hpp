// A cell with a manual clock and one line, used directly: what a line must receive that nobody
// else affects.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace xr3 {
class Model;
}

namespace xr3::seeds {

using SharedModel = std::shared_ptr<const Model>;

class Reference {
 public:
  enum class Line : std::uint8_t { kTcp, kMonitor };

  Reference(SharedModel model, Line line);
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;
  ~Reference();

  /// The replies to these bytes.
  std::string replies(std::string_view bytes);
  /// The replies that leave at the end of the input.
  std::string last_replies();
  /// The same as two hexadecimal digits a byte, as the monitor shows them.
  std::string hexadecimal_replies(std::string_view bytes);
  void step(std::int64_t ticks);
  std::int64_t tick() const;
  /// The member `joints` of the monitor's state, as JSON.
  std::string joints() const;

 private:
  class Machine;
  std::unique_ptr<Machine> machine_;
};

}  // namespace xr3::seeds
