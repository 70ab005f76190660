// Reads an MCAP file with Foxglove's own reader: node read_mcap.mjs FILE. Prints its channels and statistics as JSON on the first
// line, and then each message on a line, in the order of their times. Checksums that are wrong end it.
import { open } from "node:fs/promises";
import { createRequire } from "node:module";

const require = createRequire(new URL("../../clients/web/package.json", import.meta.url));
const { McapIndexedReader } = require("@mcap/core");
const { decompress } = require("fzstd");
const official = require("@foxglove/schemas/jsonschema");

const file = await open(process.argv[2]);
const readable = {
  size: async () => BigInt((await file.stat()).size),
  async read(offset, size) {
    const { bytesRead, buffer } = await file.read(new Uint8Array(Number(size)), 0, Number(size), Number(offset));
    if (bytesRead < size) throw new Error(`only ${bytesRead} of ${size} bytes at ${offset}`);
    return buffer;
  },
};
const reader = await McapIndexedReader.Initialize({
  readable, decompressHandlers: { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) },
});

const print = (value) => process.stdout.write(`${JSON.stringify(value, (_, each) => typeof each === "bigint" ? Number(each) : each)}\n`);
const channels = [...reader.channelsById.values()].map(({ topic, messageEncoding, schemaId }) => {
  const { name, encoding, data } = reader.schemasById.get(schemaId);
  return { topic, messageEncoding, schema: name, schemaEncoding: encoding, text: new TextDecoder().decode(data),
    official: official[name.replace("foxglove.", "")] };
});
const { messageCount, chunkCount, messageStartTime, messageEndTime } = reader.statistics;
print({ channels, library: reader.header.library, messageCount, chunkCount, messageStartTime, messageEndTime,
  compressions: [...new Set(reader.chunkIndexes.map((each) => each.compression))] });
for await (const { channelId, logTime, publishTime, data } of reader.readMessages({ validateCrcs: true }))
  print({ topic: reader.channelsById.get(channelId).topic, logTime, publishTime, data: JSON.parse(new TextDecoder().decode(data)) });
