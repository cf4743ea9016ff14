"""An exported file read by other people's reader, @mcap/core, and held to Foxglove's own schemas. Both come from npm:
skipped where there is no node, no npm or no network."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

try:
    import jsonschema
except ImportError as missing:
    raise SystemExit(f"SKIPPED: {missing}; apt-get install python3-jsonschema")

from npm import install

BINARY = os.environ["VANTAGE_BINARY"]
READ = """
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { FileHandleReadable } = require("@mcap/nodejs");
const { zstd } = { zstd: (bytes, size) => require("fzstd").decompress(bytes, new Uint8Array(Number(size))) };
const fs = require("fs");
(async () => {
  const handle = await fs.promises.open(process.argv[2], "r");
  const reader = await McapIndexedReader.Initialize({ readable: new FileHandleReadable(handle), decompressHandlers: { zstd } });
  const topics = {};
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(message.channelId);
    const name = reader.schemasById.get(channel.schemaId).name;
    (topics[channel.topic] ??= { name, messages: [] }).messages.push(JSON.parse(Buffer.from(message.data)));
  }
  const stream = new McapStreamReader({ validateCrcs: true, decompressHandlers: { zstd } });
  stream.append(fs.readFileSync(process.argv[2]));
  let streamed = 0;
  for (let record; (record = stream.nextRecord());) streamed += record.type === "Message";
  const half = reader.statistics.messageEndTime / 2n;
  let late = 0;
  for await (const message of reader.readMessages({ topics: ["/tf"], startTime: half })) late += message.logTime >= half;
  const schemas = require("@foxglove/schemas/jsonschema");
  fs.writeFileSync(process.argv[3], JSON.stringify({ topics, streamed, late, done: stream.done(),
    indexed: Number(reader.statistics.messageCount), schemas }));
})();
"""


class Npm(unittest.TestCase):
    def test_reads_what_we_write(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            install(folder)
            subprocess.run([BINARY, "run", "--set", "scans=2", "laser.scan_duration_s=2", "map.cells=[33,33,17]", "-q",
                            "--out", folder / "run"], check=True, capture_output=True)
            subprocess.run([BINARY, "export", folder / "run", "--mcap", folder / "run.mcap"], check=True,
                           capture_output=True)
            (folder / "read.js").write_text(READ)
            done = subprocess.run(["node", "read.js", "run.mcap", "read.json"], cwd=folder, capture_output=True,
                                  text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            read = json.loads((folder / "read.json").read_text())
        self.assertEqual(read["streamed"], read["indexed"])
        self.assertEqual(sum(len(topic["messages"]) for topic in read["topics"].values()), read["indexed"])
        self.assertTrue(read["done"])
        transforms = len(read["topics"]["/tf"]["messages"])
        self.assertTrue(0.4 * transforms < read["late"] < 0.6 * transforms)
        for topic, found in read["topics"].items():
            if topic == "/steps":
                continue
            schema = read["schemas"][found["name"].removeprefix("foxglove.")]
            validator = jsonschema.Draft7Validator(schema)
            for message in found["messages"]:
                self.assertEqual([error.message for error in validator.iter_errors(message)], [], topic)


if __name__ == "__main__":
    result = unittest.main(exit=False).result
    for _, why in result.skipped:
        print(f"SKIPPED: {why}")
    raise SystemExit(not result.wasSuccessful())
