#include "protocol/recording/writer.hpp"

#include <utility>

#include "protocol/recording/entry_json.hpp"

namespace xr3::recording {

std::string RecordingWriter::line(const Header& header) {
  std::string json = header_to_json(header).dump(-1, ' ', true);
  json.pop_back();  // the closing brace
  return checked(std::move(json));
}

std::string RecordingWriter::line(const Entry& entry) {
  std::string json = members_of(entry, epoch_);
  epoch_ = entry.epoch;
  return checked(std::move(json));
}

std::string RecordingWriter::checked(std::string json) {
  json += ",\"c\":\"";
  check_.add(json);
  const std::string rest = check_.text() + "\"}\n";
  check_.add(rest);
  return json + rest;
}

}  // namespace xr3::recording
