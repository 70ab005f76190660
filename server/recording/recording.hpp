// Records a cell into a file while the server runs (`--record`). Each cell has one of its own. A
// failure ends the recording, never the robot.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "cell/cell.hpp"
#include "cell/recording/recorder.hpp"
#include "protocol/recording/writer.hpp"
#include "server/net/asio.hpp"
#include "server/recording/file.hpp"

namespace xr3 {

class Recording {
 public:
  /// Begins the file with the cell's header. Precondition: no input has acted on the cell.
  /// `max_bytes`: the maximum size of the file. `acted`: called after an event of the cell. Throws
  /// FileError.
  Recording(asio::io_context& io, Cell& cell, std::string path, std::uint64_t max_bytes,
            std::function<void()> acted);
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  ~Recording();

  /// Ends the recording: the cell gets no more input.
  void finish();

 private:
  void begin_file();
  void add(const recording::Entry& entry);
  void add_line(const std::string& line);
  void flush_soon();
  void flush();
  void fail(std::string why);
  void report(const std::string& why);

  asio::io_context& io_;
  Cell& cell_;
  std::uint64_t max_bytes_;
  std::function<void()> acted_;
  RecordingFile file_;
  recording::RecordingWriter writer_;
  Recorder recorder_;
  asio::steady_timer timer_;
  bool is_timer_on_ = false;
  bool is_over_ = false;
  recording::Entry last_;  ///< without its body
};

}  // namespace xr3
