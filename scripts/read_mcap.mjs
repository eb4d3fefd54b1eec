// Part of scripts/read-mcap: node read_mcap.mjs FILE
import fs from "node:fs";
import {McapIndexedReader, McapStreamReader} from "@mcap/core";
import {parse} from "@foxglove/rosmsg";
import {MessageReader} from "@foxglove/rosmsg2-serialization";

const data = fs.readFileSync(process.argv[2]);

// Read by the index.
const readable = {
  size: async () => BigInt(data.length),
  read: async (offset, size) => data.subarray(Number(offset), Number(offset + size)),
};
const indexed = await McapIndexedReader.Initialize({readable});
const last = new Map();
const counts = new Map();
const readers = new Map();
for await (const message of indexed.readMessages({validateCrcs: true})) {
  const channel = indexed.channelsById.get(message.channelId);
  if (!readers.has(channel.id)) {
    const schema = indexed.schemasById.get(channel.schemaId);
    const definition = parse(new TextDecoder().decode(schema.data), {ros2: true});
    readers.set(channel.id, new MessageReader(definition));
  }
  counts.set(channel.topic, (counts.get(channel.topic) ?? 0) + 1);
  last.set(channel.topic, readers.get(channel.id).readMessage(message.data));
}

// Read from the beginning to the end.
const stream = new McapStreamReader({validateCrcs: true});
stream.append(data);
let messages = 0;
for (let record; (record = stream.nextRecord()); ) messages += record.type === "Message";

const total = [...counts.values()].reduce((a, b) => a + b, 0);
const said = Number(indexed.statistics.messageCount);
for (const [topic, count] of counts) {
  console.log(`${topic}: ${count} messages, the last one:`);
  console.log(JSON.stringify(last.get(topic), (_, value) =>
      ArrayBuffer.isView(value) ? [...value] : value));
}
if (!stream.done() || messages !== total || said !== total) {
  console.error(`${messages} messages in a row, ${total} by the index, ${said} by the statistics`);
  process.exit(1);
}
