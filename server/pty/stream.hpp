// A pseudo-terminal as the stream of a serial line, from the first program that opens it to the
// last that closes it.
#pragma once

#include "server/lines/stream.hpp"
#include "server/pty/watch.hpp"

namespace xr3 {

class PtyStream final : public LineStream {
 public:
  /// Begins the line of the watch's place. The watch must outlive the stream. Precondition: a
  /// program has arrived there.
  explicit PtyStream(PtyWatch& watch);

  int descriptor() const override { return is_closed_ ? -1 : place_.news_descriptor(); }
  std::size_t read(std::span<char> into) override;
  /// If no program has the terminal open, takes also what the terminal does not: nobody reads it.
  std::size_t write(std::string_view bytes) override;
  void close() override { is_closed_ = true; }
  bool is_hung_up() const override { return place_.is_leaving(); }
  std::size_t unread_bytes() const override;
  /// Those with which the last bytes came.
  std::optional<LineSettings> take_settings(LineId line) override;

 private:
  bool is_over() const;
  std::size_t read_arrived(std::span<char> into);

  PtyWatch& watch_;
  PtyPlace& place_;
  PtyModes modes_;  ///< when bytes were read last: those of the program that had written them
  PtyModes taken_;
  bool is_closed_ = false;
  bool was_full_ = false;  ///< the last write took nothing
};

}  // namespace xr3
