#include "tests/support/recorded.hpp"

#include "protocol/recording/reader.hpp"

namespace xr3::test {

RecordedCell::RecordedCell(ModelPtr model, const CellSetup& setup)
    : cell("main", std::move(model), setup.clock), recorder_([this](recording::Entry entry) {
        text_ += writer_.line(entry);
        entries_.push_back(std::move(entry));
      }) {
  if (setup.line_speed) cell.set_line_speed(*setup.line_speed);
  if (!setup.faults.faults.empty()) cell.set_faults(setup.faults);
  if (setup.has_device) cell.connect_device("/dev/arm", *parse_serial_settings("9600-7e2"));
  text_ = writer_.line(recording_header(cell, "xr3 test"));
  cell.observe(recorder_);
}

std::string RecordedCell::text() {
  recording::RecordingWriter writer = writer_;
  return text_ + writer.line(recorder_.end_of(cell, "stopped"));
}

Replayed replay(const std::string& text, std::optional<ReplayTime> until) {
  constexpr std::size_t kPiece = 1000;
  recording::RecordingReader reader("test");
  std::size_t at = 0;
  const auto add_more = [&] {
    if (at > text.size()) return false;
    if (at == text.size()) reader.end();
    reader.add(std::string_view(text).substr(at, kPiece));
    at = at == text.size() ? at + 1 : std::min(at + kPiece, text.size());
    return true;
  };
  std::optional<recording::Header> header = reader.header();
  while (!header && add_more()) header = reader.header();
  if (!header) return {};
  Cell cell(header->cell, header->model, replay_clock(*header));
  prepare_replay(cell, *header);
  Replayed result;
  result.program = header->program;
  {
    const bool compares = header->state_format == kStateFormat;
    Replayer replayer(cell, compares ? Compared::kAll : Compared::kReplies);
    if (until) replayer.stop_at(*until);
    for (;;) {
      std::optional<recording::Entry> entry = reader.next();
      while (!entry && add_more()) entry = reader.next();
      if (!entry) break;
      result.difference = replayer.apply(*entry);
      if (result.difference) break;
    }
    if (until) replayer.run_to_stop();
    result.inputs = replayer.inputs();
  }
  result.state = cell.state();
  result.hash = StateHasher().hash(cell);
  return result;
}

}  // namespace xr3::test
