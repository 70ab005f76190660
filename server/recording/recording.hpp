// Records a cell into a file while the server runs (`--record`). Each cell has one of its own. A
// failure ends the recording, never the robot.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "cell/cell.hpp"
#include "cell/recording/recorder.hpp"
#include "protocol/recording/writer.hpp"
#include "server/net/asio.hpp"
#include "server/recording/file.hpp"
#include "server/recording/room.hpp"

namespace xr3 {

struct RecordingLimits {
  std::uint64_t max_bytes = 0;    ///< of the file
  RecordingRoom* room = nullptr;  ///< shared with others, which must outlive them; nullptr: none
};

class Recording {
 public:
  /// Begins the file with the cell's header; without room for that it fails, and makes no file.
  /// Precondition: no input has acted on the cell. `acted`: called after an event of the cell.
  /// Throws FileError.
  Recording(asio::io_context& io, Cell& cell, std::string path, RecordingLimits limits,
            std::function<void()> acted);
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  ~Recording();

  /// Ends the recording: the cell gets no more input.
  void finish();

 private:
  std::string header_line();
  void begin_file(const std::string& header);
  void add(const recording::Entry& entry);
  std::string refusal(std::uint64_t bytes) const;
  std::string shortage() const;
  void add_line(const std::string& line);
  void end_early(std::string why);
  void flush_soon();
  void flush();
  void fail(std::string why);
  void report(const std::string& why);

  asio::io_context& io_;
  Cell& cell_;
  std::string path_;
  RecordingLimits limits_;
  std::function<void()> acted_;
  std::optional<RecordingFile> file_;  ///< unless there was no room for it
  recording::RecordingWriter writer_;
  Recorder recorder_;
  asio::steady_timer timer_;
  bool is_timer_on_ = false;
  bool is_over_ = false;
  recording::Entry last_;  ///< the end at the last entry, if no more fits
};

}  // namespace xr3
