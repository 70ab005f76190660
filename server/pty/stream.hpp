// The master of a pseudo-terminal as the stream of a serial line, from the first program that opens
// the slave to the last that closes it.
#pragma once

#include "server/lines/stream.hpp"
#include "server/pty/pseudo_terminal.hpp"

namespace xr3 {

class PtyStream final : public LineStream {
 public:
  /// The terminal must outlive the stream and keeps its descriptor.
  explicit PtyStream(const PseudoTerminal& terminal) : terminal_(terminal) {}

  int descriptor() const override { return is_closed_ ? -1 : terminal_.master(); }
  std::size_t read(std::span<char> into) override;
  /// Discards the bytes if no program has the slave open, for nobody could read them.
  std::size_t write(std::string_view bytes) override;
  void close() override { is_closed_ = true; }
  std::optional<LineSettings> take_settings(LineId line) override;

 private:
  const PseudoTerminal& terminal_;
  PtyModes modes_;
  bool is_closed_ = false;
  bool was_full_ = false;  ///< the last write took nothing
};

}  // namespace xr3
