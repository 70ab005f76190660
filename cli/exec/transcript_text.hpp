// The bytes of all lines of a run as readable text, for `xr3 exec --out`.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "cell/observer.hpp"

namespace xr3 {

/// Writes a line for the bytes that arrive together, or are sent together: `1300 1 > E+50\r` or
/// `1300 1 < R`, with the tick and the number of the serial line.
class TranscriptText final : public CellObserver {
 public:
  /// Maximum size; later lines are left out, and the last line says so.
  static constexpr std::size_t kMaxBytes = std::size_t{4} << 20U;

  const std::string& text() const { return text_; }

  void before(const Cell& cell, const Input& input) override;
  void happened(const Cell& cell, const CellOutput& output) override;
  void after(const Cell& cell, const Input& input, const Applied& applied) override;

 private:
  struct Transfer {
    Tick tick;
    LineId line;
    char direction;
    std::string_view text;
  };
  void add(std::size_t at, const Transfer& bytes);

  std::string text_;
  std::size_t input_at_ = 0;  ///< position in the text for the input that is being executed
  Tick input_tick_ = 0;
  bool is_full_ = false;
};

}  // namespace xr3
