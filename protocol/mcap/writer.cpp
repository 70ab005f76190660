#include "protocol/mcap/writer.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace xr3::mcap {
namespace {

std::string header(std::string_view program) {
  constexpr std::string_view kNoProfile;
  return record(Opcode::kHeader, RecordContent().text(kNoProfile).text(program));
}

std::string schema_record(SchemaNumber number, const McapChannel& channel) {
  return record(Opcode::kSchema, RecordContent()
                                     .number(number)
                                     .text(channel.schema_name)
                                     .text("jsonschema")
                                     .text(channel.schema));
}

std::string channel_record(ChannelNumber number, SchemaNumber schema, const McapChannel& channel) {
  constexpr std::string_view kNoMetadata;
  return record(Opcode::kChannel, RecordContent()
                                      .number(number)
                                      .number(schema)
                                      .text(channel.topic)
                                      .text("json")
                                      .text(kNoMetadata));
}

std::string summary_offset(Opcode group, std::uint64_t start, std::uint64_t size) {
  return record(
      Opcode::kSummaryOffset,
      RecordContent().number(static_cast<std::uint8_t>(group)).number(start).number(size));
}

/// The number in the file of the channel with this index.
ChannelNumber number_of(std::size_t index) { return static_cast<ChannelNumber>(index + 1); }

void widen(LogSpan& span, const LogSpan& other) {
  span = {std::min(span.first, other.first), std::max(span.last, other.last)};
}

}  // namespace

McapWriter::McapWriter(McapSink sink, std::string_view program,
                       const std::vector<McapChannel>& channels, McapCompression compression)
    : sink_(std::move(sink)), compression_(std::move(compression)) {
  declare(channels);
  write(kMagic);
  write(header(program));
  write(schemas_);
  write(channels_);
}

void McapWriter::declare(const std::vector<McapChannel>& channels) {
  std::map<std::string, SchemaNumber> numbers;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const auto [schema, is_new] = numbers.try_emplace(channels[i].schema_name, schema_count_ + 1);
    if (is_new) schemas_ += schema_record(++schema_count_, channels[i]);
    channels_ += channel_record(number_of(i), schema->second, channels[i]);
    counts_[number_of(i)] = 0;
  }
}

void McapWriter::write(std::string_view bytes) {
  sink_(bytes);
  data_crc_.add(bytes);
  offset_ += bytes.size();
}

// --- Chunks.

void McapWriter::add(std::size_t channel, LogTime time, std::string_view message) {
  assert(channel < counts_.size());
  const ChannelNumber number = number_of(channel);
  const auto sequence = static_cast<std::uint32_t>(++counts_[number]);
  if (chunk_.records.empty()) chunk_.span = {time, time};
  widen(chunk_.span, {time, time});
  chunk_.messages[number].emplace_back(time, chunk_.records.size());
  chunk_.records += record(
      Opcode::kMessage,
      RecordContent().number(number).number(sequence).number(time).number(time).raw(message));
  if (chunk_.records.size() >= kChunkBytes) end_chunk();
}

void McapWriter::end_chunk() {
  if (chunk_.records.empty()) return;
  const std::string& records = chunk_.records;
  const std::string packed = compression_.name.empty() ? records : compression_.compress(records);
  const std::string chunk = record(Opcode::kChunk, RecordContent()
                                                       .number(chunk_.span.first)
                                                       .number(chunk_.span.last)
                                                       .number(std::uint64_t{records.size()})
                                                       .number(crc32(records))
                                                       .text(compression_.name)
                                                       .number(std::uint64_t{packed.size()})
                                                       .raw(packed));
  ChunkIndex index{chunk_.span, offset_,           chunk.size(),  {},
                   0,           compression_.name, packed.size(), records.size()};
  write(chunk);
  write_message_indexes(index);
  chunks_.push_back(std::move(index));
  chunk_ = {};
}

void McapWriter::write_message_indexes(ChunkIndex& index) {
  const std::uint64_t start = offset_;
  for (const auto& [channel, messages] : chunk_.messages) {
    index.message_indexes[channel] = offset_;
    write(message_index(channel, messages));
  }
  index.message_indexes_size = offset_ - start;
}

// --- The end.

void McapWriter::finish() {
  end_chunk();
  write_data_end();
  write_summary();
  sink_(kMagic);
}

void McapWriter::write_data_end() {
  write(record(Opcode::kDataEnd, RecordContent().number(data_crc_.value())));
}

void McapWriter::write_summary() {
  std::string summary;
  std::string offsets;
  const auto add_group = [&](Opcode opcode, const std::string& records) {
    if (records.empty()) return;
    offsets += summary_offset(opcode, offset_ + summary.size(), records.size());
    summary += records;
  };
  add_group(Opcode::kSchema, schemas_);
  add_group(Opcode::kChannel, channels_);
  add_group(Opcode::kStatistics, statistics());
  add_group(Opcode::kChunkIndex, chunk_indexes());
  const std::uint64_t offsets_start = offset_ + summary.size();
  summary += offsets;
  // The checksum is of all bytes of the summary, and of the footer before the checksum itself.
  const auto footer = [&](std::uint32_t crc) {
    return record(Opcode::kFooter,
                  RecordContent().number(offset_).number(offsets_start).number(crc));
  };
  const std::string unchecked = footer(0);
  const std::uint32_t crc =
      crc32(summary + unchecked.substr(0, unchecked.size() - sizeof(std::uint32_t)));
  sink_(summary + footer(crc));
}

std::string McapWriter::statistics() const {
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : counts_) messages += count;
  LogSpan span = chunks_.empty() ? LogSpan{} : chunks_.front().span;
  for (const ChunkIndex& chunk : chunks_) widen(span, chunk.span);
  constexpr std::uint32_t kNoAttachments = 0;
  constexpr std::uint32_t kNoMetadata = 0;
  return record(Opcode::kStatistics, RecordContent()
                                         .number(messages)
                                         .number(schema_count_)
                                         .number(static_cast<std::uint32_t>(counts_.size()))
                                         .number(kNoAttachments)
                                         .number(kNoMetadata)
                                         .number(static_cast<std::uint32_t>(chunks_.size()))
                                         .number(span.first)
                                         .number(span.last)
                                         .pairs(counts_));
}

std::string McapWriter::chunk_indexes() const {
  std::string records;
  for (const ChunkIndex& chunk : chunks_) records += record_of(chunk);
  return records;
}

}  // namespace xr3::mcap
