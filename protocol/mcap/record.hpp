// The records of MCAP 0 as bytes, by its specification: an opcode, the length of the content in
// eight bytes, and the content. Numbers are little-endian.
#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace xr3::mcap {

/// Nanoseconds; the origin is the file's own.
using LogTime = std::uint64_t;
using ChannelNumber = std::uint16_t;
using SchemaNumber = std::uint16_t;

/// The first and the last bytes of a file; the sixth is the version.
inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// The content of a record, field by field.
class RecordContent {
 public:
  template <std::unsigned_integral Number>
  RecordContent& number(Number value) {
    for (std::size_t i = 0; i < sizeof(Number); ++i)
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i));
    return *this;
  }
  /// Without a length before it.
  RecordContent& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  /// With its length in four bytes.
  RecordContent& text(std::string_view text) {
    return number(static_cast<std::uint32_t>(text.size())).raw(text);
  }
  /// Pairs, with their length in bytes before them.
  template <class Pairs>
  RecordContent& pairs(const Pairs& pairs) {
    RecordContent all;
    for (const auto& [key, value] : pairs) all.number(key).number(value);
    return text(all.bytes_);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// The bytes of opcode and length.
inline constexpr std::size_t kRecordHead = 9;

std::string record(Opcode opcode, const RecordContent& content);

/// The times of the first and the last message.
struct LogSpan {
  LogTime first = 0;
  LogTime last = 0;
};

/// A chunk as the summary describes it.
struct ChunkIndex {
  LogSpan span;
  std::uint64_t offset = 0;                                ///< offset of its record in the file
  std::uint64_t size = 0;                                  ///< size of its record
  std::map<ChannelNumber, std::uint64_t> message_indexes;  ///< offsets of their records
  std::uint64_t message_indexes_size = 0;
  std::string compression;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
};
std::string record_of(const ChunkIndex& index);

/// The times of the messages of a channel in a chunk, and their offsets in its uncompressed bytes.
using MessageOffsets = std::vector<std::pair<LogTime, std::uint64_t>>;
std::string message_index(ChannelNumber channel, const MessageOffsets& messages);

}  // namespace xr3::mcap
