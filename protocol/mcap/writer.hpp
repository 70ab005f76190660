// Writes MCAP 0, a file of messages on several channels over time that Foxglove and others read:
// https://mcap.dev/spec. The messages are in compressed chunks with indexes, so that a reader finds
// a moment without reading the whole file. The memory is that of one chunk, and some 150 bytes for
// each chunk before it. Independent of what the messages are.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/mcap/crc32.hpp"
#include "protocol/mcap/record.hpp"

namespace xr3::mcap {

/// A channel of messages in JSON. Channels with the same schema name have the same schema.
struct McapChannel {
  std::string topic;
  std::string schema_name;
  std::string schema;  ///< text of a JSON Schema
};

struct McapCompression {
  std::string name;  ///< such as `zstd`; empty for none
  std::function<std::string(std::string_view)> compress;
};

class McapWriter {
 public:
  /// Takes the next bytes of the file.
  using McapSink = std::function<void(std::string_view)>;

  /// The size of a chunk before compression, in bytes: one that has reached it is written.
  static constexpr std::size_t kChunkBytes = std::size_t{1} << 20U;

  /// Writes the beginning of the file. `program`: name and version.
  McapWriter(McapSink sink, std::string_view program, const std::vector<McapChannel>& channels,
             McapCompression compression = {});

  /// Adds a message. Precondition: `channel` is the index of a channel.
  void add(std::size_t channel, LogTime time, std::string_view message);
  /// Writes the end of the file, after which nothing more is added.
  void finish();

 private:
  struct OpenChunk {
    std::string records;
    LogSpan span;
    std::map<ChannelNumber, MessageOffsets> messages;
  };

  void declare(const std::vector<McapChannel>& channels);
  void write(std::string_view bytes);
  void end_chunk();
  void write_message_indexes(ChunkIndex& index);
  void write_data_end();
  void write_summary();
  std::string statistics() const;
  std::string chunk_indexes() const;

  McapSink sink_;
  McapCompression compression_;
  std::uint64_t offset_ = 0;  ///< offset of the next byte in the file
  Crc32 data_crc_;            ///< checksum of all bytes so far
  std::string schemas_;       ///< records of the schemas, repeated in the summary
  SchemaNumber schema_count_ = 0;
  std::string channels_;  ///< records of the channels, repeated in the summary
  OpenChunk chunk_;
  std::vector<ChunkIndex> chunks_;
  std::map<ChannelNumber, std::uint64_t> counts_;  ///< numbers of messages
};

}  // namespace xr3::mcap
