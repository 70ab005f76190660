// Records a cell into a file while the server runs (`--record`). Each cell has a file of its own. A
// failure ends the recording, never the robot.
//
// The flow through the folder: the server makes a Recording for a cell before its first input. It
// writes the header with robot, workcell and settings (protocol/recording/header.hpp), and adds
// itself as a log of the cell: each input becomes an entry (cell/recording), each entry a line of
// JSON with a running check (protocol/recording/writer.hpp). RecordingFile (file.hpp) collects the
// lines and writes them within a tenth of a second, without waiting for the disk; it makes only new
// files, for their owner alone. RecordingRoom (room.hpp) is shared by the recordings of all cells:
// it limits their total and keeps space on the disk free. When a limit is reached, or a write
// fails, the recording ends with a last line that says so, an event goes to the log and to the
// monitor, and the cell continues. Of several cells, daily_files.hpp begins a new
// file each day, folder.hpp names the files, and retention.hpp deletes old ones. The other way,
// source.hpp reads a recording piece by piece, and recorded_end.hpp repeats it to its end, from
// which a cell can go on. joint_table.hpp is independent of all: a table of joints over time.
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
  std::uint64_t max_bytes = 0;  ///< maximum size of the file
  /// Shared with other recordings, which it must outlive; nullptr if there is none.
  RecordingRoom* room = nullptr;
};

class Recording {
 public:
  /// Begins the file with the cell's header; without room for that it fails, and makes no file.
  /// `on_input`: called after an event of the cell. Throws FileError. Precondition: no input has
  /// been applied to the cell.
  Recording(asio::io_context& io, Cell& cell, std::string path, RecordingLimits limits,
            std::function<void()> on_input);
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  ~Recording();

  /// Ends the file, and goes on in a new one, with the state of the cell in its header. A failure
  /// ends the recording as any other does. No effect if it has ended. Precondition: no line is
  /// open.
  void go_on_in(const std::function<std::string()>& new_path);

  /// Ends the recording. Call after the last input of the cell.
  void finish();

 private:
  void begin();
  void end_file();
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
  std::function<void()> on_input_;
  std::string origin_;  ///< recording::ContinuedState::origin; empty before a first file
  std::optional<RecordingFile> file_;  ///< nullopt if there was no room for it
  recording::RecordingWriter writer_;
  Recorder recorder_;
  asio::steady_timer timer_;
  bool is_timer_on_ = false;
  bool is_over_ = false;
  recording::Entry last_;  ///< the end after the last entry, written when no more fits
};

}  // namespace xr3
