// Fuzzes the reader of recordings and the replay. Properties: any text gives entries or an error;
// an entry is equal after writing and reading; a replay of any entries on a fresh cell ends, with
// or without a difference, and its replies in memory are bounded.
//
// Input: the first byte selects what follows. Bit 7: the text of a file, with its checks. Otherwise
// entries, one a line, without checks; bits 0 and 1: clock and line speed, bit 2: a device.
#include <string>
#include <string_view>

#include "cell/recording/replayer.hpp"
#include "protocol/recording/entry_json.hpp"
#include "protocol/recording/reader.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/support/models.hpp"

namespace xr3::fuzz::recording_fuzzer {
namespace {

recording::Header header_for(unsigned choice) {
  static const ModelPtr model = test::rhino();
  recording::Header header;
  header.program = "fuzz";
  header.state_format = kStateFormat;
  header.cell = "fuzz";
  header.model = model;
  header.mode = (choice & 1U) != 0 ? ClockMode::kManual : ClockMode::kReal;
  if ((choice & 2U) != 0) header.line_speed = LineSpeed{parse_serial_settings("9600-7e2"), {}};
  if ((choice & 4U) != 0) {
    header.mode = ClockMode::kReal;
    header.line_speed.reset();
    header.device = recording::RecordedDevice{"arm", *parse_serial_settings("9600-7e2"), false};
  }
  return header;
}

void read_file_text(std::string_view text) {
  recording::RecordingReader reader("fuzz");
  try {
    reader.add(text);
    if (!reader.header()) return reader.end();
    while (reader.next()) {
    }
    reader.end();
  } catch (const DataError& error) {
    require(!error.findings().empty(), "an error says why");
    require(error.findings().front().line > 0, "an error has its line");
  }
}

std::optional<recording::Entry> entry_of(std::string_view line, Epoch epoch) {
  const JsonDocument document(line);
  if (document.fault() != JsonDocument::SyntaxFault::kNone) return std::nullopt;
  data::Reading reading(document.root(), data::Unit::kMm);
  auto entry = recording::read_entry(reading, epoch);
  require(entry.has_value() != reading.has_errors(), "an entry, or why not");
  if (!entry) return entry;
  const std::string written = recording::members_of(*entry, epoch) + "}";
  const JsonDocument second(written);
  data::Reading again(second.root(), data::Unit::kMm);
  const auto read = recording::read_entry(again, epoch);
  require(read && recording::members_of(*read, epoch) + "}" == written,
          "the entry written and read again");
  return entry;
}

void replay_lines(std::string_view text, unsigned choice) {
  const recording::Header header = header_for(choice);
  Cell cell(header.cell, header.model, replay_clock(header));
  prepare_replay(cell, header);
  Replayer replayer(cell, Compared::kAll);
  Epoch epoch = 0;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const auto entry = entry_of(line, epoch);
    if (!entry) continue;
    epoch = entry->epoch;
    if (replayer.apply(*entry)) return;
  }
}

void run(std::string_view input, Effort) {
  if (input.empty()) return;
  constexpr unsigned kIsFile = 0x80;
  const auto choice = static_cast<unsigned char>(input[0]);
  if ((choice & kIsFile) != 0) return read_file_text(input.substr(1));
  replay_lines(input.substr(1), choice);
}

const Registration kRegistration{{"recording", 4096, run}};

}  // namespace
}  // namespace xr3::fuzz::recording_fuzzer
