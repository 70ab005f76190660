// The bytes of small files against the specification of MCAP, read by offsets that are written out
// here. A reader of other people reads whole files in tests/play/mcap_test.mjs.
#include "protocol/mcap/writer.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace xr3::mcap {
namespace {

using namespace std::string_literals;  // NOLINT: texts with zeros

/// Reads numbers and texts of a record one after the other.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : rest_(bytes) {}

  std::uint64_t number(std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8U | static_cast<std::uint8_t>(rest_[i]);
    rest_.remove_prefix(size);
    return value;
  }
  std::string_view text() { return raw(number(4)); }
  std::string_view raw(std::size_t size) {
    const std::string_view bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return bytes;
  }
  bool is_at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

struct FoundRecord {
  std::uint64_t opcode = 0;
  std::size_t offset = 0;
  std::string_view whole;
  std::string_view content;
};

std::vector<FoundRecord> records_in(std::string_view bytes, std::size_t offset = 0) {
  std::vector<FoundRecord> found;
  while (offset < bytes.size()) {
    Fields head(bytes.substr(offset));
    const std::uint64_t opcode = head.number(1);
    const std::size_t size = head.number(8);
    found.push_back(
        {opcode, offset, bytes.substr(offset, 9 + size), bytes.substr(offset + 9, size)});
    offset += 9 + size;
  }
  return found;
}

struct WrittenFile {
  std::string bytes{};
  McapWriter::McapSink sink() {
    return [this](std::string_view more) { bytes += more; };
  }
  /// All records between the first and the last magic.
  std::vector<FoundRecord> records() const {
    return records_in(std::string_view(bytes).substr(0, bytes.size() - kMagic.size()),
                      kMagic.size());
  }
  std::vector<FoundRecord> all(Opcode opcode) const {
    auto found = records();
    std::erase_if(found, [&](const FoundRecord& each) {
      return each.opcode != static_cast<std::uint64_t>(opcode);
    });
    return found;
  }
  FoundRecord last(Opcode opcode) const { return all(opcode).back(); }
};

const std::vector<McapChannel> kTwo = {{"/tf", "Tf", "{}"}, {"/log", "Log", R"({"a":1})"}};

WrittenFile small_file(const McapCompression& compression = {}) {
  WrittenFile file;
  McapWriter writer(file.sink(), "xr3 1.2", kTwo, compression);
  writer.add(0, 1000, "one");
  writer.add(1, 2000, "two");
  writer.add(0, 3000, "three");
  writer.finish();
  return file;
}

std::string opcodes_of(const std::vector<FoundRecord>& records) {
  std::string text;
  for (const FoundRecord& each : records) text += std::to_string(each.opcode) + " ";
  return text;
}

TEST(McapWriter, BeginsAndEndsWithTheMagicOfVersion0) {
  const std::string bytes = small_file().bytes;
  EXPECT_EQ(bytes.substr(0, 8), "\x89MCAP0\r\n");
  EXPECT_EQ(bytes.substr(bytes.size() - 8), "\x89MCAP0\r\n");
}

TEST(McapWriter, WritesRecordsInTheOrderOfTheSpecification) {
  const WrittenFile file = small_file();
  EXPECT_EQ(opcodes_of(file.records()),
            "1 3 3 4 4 6 7 7 15 "            // header, schemas, channels, chunk, indexes, end
            "3 3 4 4 11 8 14 14 14 14 2 ");  // summary, its offsets, footer
}

TEST(McapWriter, WritesHeaderSchemaAndChannelByteByByte) {
  const std::string begin = small_file().bytes.substr(8);
  const std::string expected =
      "\x01\x0f\0\0\0\0\0\0\0"
      "\0\0\0\0"
      "\x07\0\0\0xr3 1.2"s +
      "\x03\x1c\0\0\0\0\0\0\0"
      "\x01\0"
      "\x02\0\0\0Tf"
      "\x0a\0\0\0jsonschema"
      "\x02\0\0\0{}"s;
  EXPECT_EQ(begin.substr(0, expected.size()), expected);
  const std::string channel =
      "\x04\x17\0\0\0\0\0\0\0"
      "\x01\0"
      "\x01\0"
      "\x03\0\0\0/tf"
      "\x04\0\0\0json"
      "\0\0\0\0"s;
  const WrittenFile file = small_file();
  EXPECT_EQ(file.all(Opcode::kChannel).front().whole, channel);
}

TEST(McapWriter, WritesASchemaOnceForAllItsChannels) {
  WrittenFile file;
  McapWriter writer(file.sink(), "xr3",
                    {{"/a", "Same", "{}"}, {"/b", "Same", "{}"}, {"/c", "Other", "{}"}});
  writer.finish();
  EXPECT_EQ(opcodes_of(file.records()), "1 3 3 4 4 4 15 3 3 4 4 4 11 14 14 14 2 ");
  std::string schemas;
  for (const FoundRecord& each : file.all(Opcode::kChannel))
    schemas += std::to_string(Fields(each.content.substr(2)).number(2));
  EXPECT_EQ(schemas, "112112");
}

TEST(McapWriter, PutsMessagesIntoAChunkWithItsChecksum) {
  const WrittenFile file = small_file();
  Fields chunk(file.last(Opcode::kChunk).content);
  EXPECT_EQ(chunk.number(8), 1000U);
  EXPECT_EQ(chunk.number(8), 3000U);
  const std::uint64_t size = chunk.number(8);
  const std::uint64_t crc = chunk.number(4);
  EXPECT_EQ(chunk.text(), "");
  ASSERT_EQ(chunk.number(8), size);
  const std::string_view messages = chunk.raw(size);
  EXPECT_TRUE(chunk.is_at_end());
  EXPECT_EQ(crc, crc32(messages));
  const auto found = records_in(messages);
  EXPECT_EQ(opcodes_of(found), "5 5 5 ");
  Fields third(found[2].content);
  EXPECT_EQ(third.number(2), 1U);     // channel
  EXPECT_EQ(third.number(4), 2U);     // sequence: the second message of its channel
  EXPECT_EQ(third.number(8), 3000U);  // log time
  EXPECT_EQ(third.number(8), 3000U);  // publish time
  EXPECT_EQ(third.raw(5), "three");
}

TEST(McapWriter, IndexesTheMessagesOfAChunk) {
  const WrittenFile file = small_file();
  const auto indexes = file.all(Opcode::kMessageIndex);
  ASSERT_EQ(indexes.size(), 2U);
  Fields first(indexes[0].content);
  EXPECT_EQ(first.number(2), 1U);
  EXPECT_EQ(first.number(4), 32U);  // bytes of two pairs
  EXPECT_EQ(first.number(8), 1000U);
  EXPECT_EQ(first.number(8), 0U);
  EXPECT_EQ(first.number(8), 3000U);
  EXPECT_EQ(first.number(8), 2 * (9 + 22 + 3));  // after two messages of three letters
}

TEST(McapWriter, IndexesItsChunks) {
  const WrittenFile file = small_file();
  const FoundRecord chunk = file.last(Opcode::kChunk);
  const auto indexes = file.all(Opcode::kMessageIndex);
  Fields index(file.last(Opcode::kChunkIndex).content);
  EXPECT_EQ(index.number(8), 1000U);
  EXPECT_EQ(index.number(8), 3000U);
  EXPECT_EQ(index.number(8), chunk.offset);
  EXPECT_EQ(index.number(8), chunk.whole.size());
  EXPECT_EQ(index.number(4), 20U);
  for (std::size_t i = 0; i < indexes.size(); ++i) {
    EXPECT_EQ(index.number(2), i + 1);
    EXPECT_EQ(index.number(8), indexes[i].offset);
  }
  EXPECT_EQ(index.number(8), indexes[0].whole.size() + indexes[1].whole.size());
  EXPECT_EQ(index.text(), "");
  EXPECT_EQ(index.number(8), index.number(8));  // compressed, uncompressed
  EXPECT_TRUE(index.is_at_end());
}

TEST(McapWriter, CountsMessagesInTheStatistics) {
  const WrittenFile file = small_file();
  Fields statistics(file.last(Opcode::kStatistics).content);
  EXPECT_EQ(statistics.number(8), 3U);
  EXPECT_EQ(statistics.number(2), 2U);
  EXPECT_EQ(statistics.number(4), 2U);
  EXPECT_EQ(statistics.number(4), 0U);
  EXPECT_EQ(statistics.number(4), 0U);
  EXPECT_EQ(statistics.number(4), 1U);
  EXPECT_EQ(statistics.number(8), 1000U);
  EXPECT_EQ(statistics.number(8), 3000U);
  EXPECT_EQ(statistics.text(), "\x01\0\x02\0\0\0\0\0\0\0\x02\0\x01\0\0\0\0\0\0\0"s);
  EXPECT_TRUE(statistics.is_at_end());
}

TEST(McapWriter, EndsWithOffsetsAndChecksums) {
  const WrittenFile file = small_file();
  const std::string_view bytes = file.bytes;
  const FoundRecord data_end = file.last(Opcode::kDataEnd);
  EXPECT_EQ(Fields(data_end.content).number(4), crc32(bytes.substr(0, data_end.offset)));
  const auto offsets = file.all(Opcode::kSummaryOffset);
  for (const FoundRecord& each : offsets) {
    Fields group(each.content);
    const std::uint64_t opcode = group.number(1);
    EXPECT_EQ(static_cast<std::uint8_t>(bytes[group.number(8)]), opcode);
  }
  const FoundRecord footer = file.last(Opcode::kFooter);
  Fields fields(footer.content);
  const std::uint64_t summary = fields.number(8);
  EXPECT_EQ(summary, data_end.offset + data_end.whole.size());
  EXPECT_EQ(fields.number(8), offsets.front().offset);
  const std::size_t checked = footer.offset + 9 + 16 - summary;
  EXPECT_EQ(fields.number(4), crc32(bytes.substr(summary, checked)));
}

TEST(McapWriter, EndsAChunkThatIsFull) {
  WrittenFile file;
  McapWriter writer(file.sink(), "xr3", kTwo);
  const std::string large(McapWriter::kChunkBytes / 4, 'x');
  for (LogTime time = 0; time < 9; ++time) writer.add(0, time, large);
  EXPECT_GT(file.bytes.size(), 2 * McapWriter::kChunkBytes);
  writer.finish();
  EXPECT_EQ(file.all(Opcode::kChunk).size(), 3U);
  EXPECT_EQ(file.all(Opcode::kChunkIndex).size(), 3U);
  for (const FoundRecord& chunk : file.all(Opcode::kChunk))
    EXPECT_LT(chunk.whole.size(), McapWriter::kChunkBytes + large.size() + 1000);
}

TEST(McapWriter, CompressesChunksAndNamesTheCompression) {
  const auto reversed = [](std::string_view bytes) {
    return std::string(bytes.rbegin(), bytes.rend()) + "!";
  };
  const WrittenFile file = small_file({"mirror", reversed});
  const WrittenFile uncompressed = small_file();
  Fields plain(uncompressed.last(Opcode::kChunk).content.substr(16));
  Fields chunk(file.last(Opcode::kChunk).content.substr(16));
  const std::uint64_t size = chunk.number(8);
  EXPECT_EQ(size, plain.number(8));
  EXPECT_EQ(chunk.number(4), plain.number(4)) << "checksum of the uncompressed bytes";
  EXPECT_EQ(chunk.text(), "mirror");
  EXPECT_EQ(plain.text(), "");
  ASSERT_EQ(chunk.number(8), size + 1);
  EXPECT_EQ(plain.number(8), size);
  EXPECT_EQ(chunk.raw(size + 1), reversed(plain.raw(size)));
}

TEST(McapWriter, AFileWithoutMessagesIsWhole) {
  WrittenFile file;
  McapWriter(file.sink(), "xr3", kTwo).finish();
  EXPECT_EQ(file.all(Opcode::kChunk).size(), 0U);
  Fields statistics(file.last(Opcode::kStatistics).content);
  EXPECT_EQ(statistics.number(8), 0U);
  EXPECT_EQ(file.bytes.substr(file.bytes.size() - 8), kMagic);
}

}  // namespace
}  // namespace xr3::mcap
