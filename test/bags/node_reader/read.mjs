// Reads MCAP files as Foxglove does; prints, for each, by topic: messages, digest of their numbers,
// digest of their words. A line of paths a file set: {"paths": [...]} in, {"topic": [...]} out.

import { createHash } from "node:crypto";
import { open } from "node:fs/promises";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader } from "@mcap/core";
import { decompress } from "fzstd";

const decompressHandlers = { zstd: (data) => decompress(data) };

async function readable(path) {
  const file = await open(path);
  const { size } = await file.stat();
  return {
    size: async () => BigInt(size),
    read: async (offset, length) => {
      const buffer = new Uint8Array(Number(length));
      await file.read(buffer, 0, Number(length), Number(offset));
      return buffer;
    },
  };
}

function* parts(value) {
  if (typeof value === "object") {
    for (const each of ArrayBuffer.isView(value) ? value : Object.values(value)) yield* parts(each);
  } else {
    yield typeof value === "string" ? value : Number(value);
  }
}

async function read(path, topics) {
  const reader = await McapIndexedReader.Initialize({ readable: await readable(path), decompressHandlers });
  const readers = new Map();
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    if (!readers.has(channel.id)) {
      const schema = reader.schemasById.get(channel.schemaId);
      const definition = new TextDecoder().decode(schema.data);
      readers.set(channel.id, new MessageReader(parse(definition, { ros2: true })));
    }
    const topic = (topics[channel.topic] ??= [0, createHash("sha256"), createHash("sha256")]);
    topic[0] += 1;
    const numbers = [];
    for (const part of parts(readers.get(channel.id).readMessage(message.data))) {
      if (typeof part === "string") topic[2].update(part + "\n");
      else numbers.push(part);
    }
    topic[1].update(new Uint8Array(Float64Array.from(numbers).buffer));
  }
}

const found = [];
for (const paths of JSON.parse(process.argv[2])) {
  const topics = {};
  for (const path of paths) await read(path, topics);
  for (const topic of Object.values(topics)) {
    topic[1] = topic[1].digest("hex");
    topic[2] = topic[2].digest("hex");
  }
  found.push(topics);
}
console.log(JSON.stringify(found));
