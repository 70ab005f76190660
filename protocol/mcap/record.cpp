#include "protocol/mcap/record.hpp"

namespace xr3::mcap {

std::string record(Opcode opcode, const RecordContent& content) {
  RecordContent whole;
  whole.number(static_cast<std::uint8_t>(opcode))
      .number(std::uint64_t{content.bytes().size()})
      .raw(content.bytes());
  return whole.bytes();
}

std::string record_of(const ChunkIndex& index) {
  return record(Opcode::kChunkIndex, RecordContent()
                                         .number(index.span.first)
                                         .number(index.span.last)
                                         .number(index.offset)
                                         .number(index.size)
                                         .pairs(index.message_indexes)
                                         .number(index.message_indexes_size)
                                         .text(index.compression)
                                         .number(index.compressed_size)
                                         .number(index.uncompressed_size));
}

std::string message_index(ChannelNumber channel, const MessageOffsets& messages) {
  return record(Opcode::kMessageIndex, RecordContent().number(channel).pairs(messages));
}

}  // namespace xr3::mcap
