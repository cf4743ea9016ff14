"""Reads an MCAP file by the specification alone (https://mcap.dev/spec) and holds it to everything that it promises:
checksums, index, summary, counts."""

import struct
import subprocess
import zlib

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = range(1, 9)
STATISTICS, METADATA, METADATA_INDEX, SUMMARY_OFFSET, DATA_END = range(11, 16)


def require(condition, what):
    if not condition:
        raise ValueError(what)


class Fields:
    """The content of a record, from front to back."""

    def __init__(self, content):
        self.content, self.at = content, 0

    def take(self, form):
        values = struct.unpack_from("<" + form, self.content, self.at)
        self.at += struct.calcsize("<" + form)
        return values[0] if len(values) == 1 else values

    def block(self, size):
        require(self.at + size <= len(self.content), "a record ends within a field")
        self.at += size
        return self.content[self.at - size:self.at]

    def text(self):
        return self.block(self.take("I")).decode()

    def pairs(self, form):
        """A map or an array of pairs of numbers."""
        inner = Fields(self.block(self.take("I")))
        found = []
        while inner.at < len(inner.content):
            found.append(inner.take(form))
        return found

    def texts(self):
        inner, found = Fields(self.block(self.take("I"))), {}
        while inner.at < len(inner.content):
            key = inner.text()
            found[key] = inner.text()
        return found

    def rest(self):
        return self.block(len(self.content) - self.at)

    def end(self):
        require(self.at == len(self.content), "a record has bytes too many")


def records(data, begin, end):
    """(opcode, content, offset, length) of each record."""
    while begin < end:
        opcode, size = struct.unpack_from("<BQ", data, begin)
        require(begin + 9 + size <= end, "a record ends beyond its section")
        yield opcode, data[begin + 9:begin + 9 + size], begin, 9 + size
        begin += 9 + size


def unpacked(compression, packed):
    require(compression in ("", "zstd"), f"compression {compression}")
    if not compression:
        return packed
    return subprocess.run(["zstd", "-dc"], input=packed, capture_output=True, check=True).stdout


class McapFile:
    """channels: id -> (topic, name of schema); messages: (channel id, time in ns, bytes), in the order of the file."""

    def __init__(self, data):
        self.schemas, self.channels, self.messages, self.metadata = {}, {}, [], {}
        self.chunks, self.sequence = {}, {}
        require(data.startswith(MAGIC) and data.endswith(MAGIC), "magic")
        footer_at = len(data) - 8 - 29
        (opcode, footer, _, _), = records(data, footer_at, len(data) - 8)
        require(opcode == FOOTER, "the last record is no footer")
        summary_start, offsets_start, summary_crc = struct.unpack("<QQI", footer)
        require(summary_crc == zlib.crc32(data[summary_start:len(data) - 12]), "checksum of the summary")
        self.read_data(data, summary_start)
        self.read_summary(data, summary_start, offsets_start, footer_at)

    def read_data(self, data, end):
        everything = list(records(data, 8, end))
        require(everything[0][0] == HEADER and everything[-1][0] == DATA_END, "begins with header, ends with data end")
        crc, = struct.unpack("<I", everything[-1][1])
        require(crc == zlib.crc32(data[:everything[-1][2]]), "checksum of the data")
        self.library = (Fields(everything[0][1]).text(), self.text_after(everything[0][1]))
        chunk = None
        for opcode, content, offset, length in everything[1:-1]:
            if opcode == CHUNK:
                chunk = self.read_chunk(content, offset, length)
            elif opcode == MESSAGE_INDEX:
                self.check_message_index(content, chunk, offset, length)
            elif opcode == METADATA:
                fields = Fields(content)
                name = fields.text()
                self.metadata[name] = (fields.texts(), offset, length)
            else:
                require(False, f"a record of kind {opcode} among the data")

    @staticmethod
    def text_after(content):
        fields = Fields(content)
        fields.text()
        return fields.text()

    def read_chunk(self, content, offset, length):
        fields = Fields(content)
        first, last, size, crc = fields.take("QQQI")
        compression = fields.text()
        packed = fields.block(fields.take("Q"))
        fields.end()
        inside = unpacked(compression, packed)
        require(len(inside) == size and zlib.crc32(inside) == crc, "size or checksum of a chunk")
        chunk = {"length": length, "times": (first, last), "size": size, "packed": len(packed), "records": {},
                 "compression": compression, "indexes": {}, "index_length": 0}
        times = []
        for opcode, record, at, _ in records(inside, 0, size):
            if opcode == MESSAGE:
                times.append(self.read_message(record, at, chunk))
            else:
                require(opcode in (SCHEMA, CHANNEL), f"a record of kind {opcode} in a chunk")
                self.read_definition(opcode, record)
        require(not times or (min(times), max(times)) == (first, last), "times of a chunk")
        self.chunks[offset] = chunk
        return chunk

    def definition(self, opcode, record):
        fields = Fields(record)
        if opcode == SCHEMA:
            key, value = fields.take("H"), (fields.text(), fields.text(), fields.block(fields.take("I")))
        else:
            key, schema = fields.take("HH")
            value = (fields.text(), schema, fields.text())
            fields.texts()
        fields.end()
        return key, value

    def read_definition(self, opcode, record):
        key, value = self.definition(opcode, record)
        require(opcode == SCHEMA or value[1] in self.schemas, "a channel before its schema")
        known = self.schemas if opcode == SCHEMA else self.channels
        require(key > 0 and key not in known, "an id that is given twice")
        known[key] = value

    def read_message(self, record, at, chunk):
        fields = Fields(record)
        channel, sequence, time, published = fields.take("HIQQ")
        require(channel in self.channels, "a message before its channel")
        require(sequence == self.sequence.get(channel, 0) and time == published, "sequence of messages")
        self.sequence[channel] = sequence + 1
        self.messages.append((channel, time, fields.rest()))
        chunk["records"].setdefault(channel, []).append((time, at))
        return time

    @staticmethod
    def check_message_index(content, chunk, offset, length):
        fields = Fields(content)
        channel = fields.take("H")
        require(fields.pairs("QQ") == chunk["records"][channel], "a message index that leads elsewhere")
        require(channel not in chunk["indexes"], "two indexes of one channel")
        chunk["indexes"][channel] = offset
        chunk["index_length"] += length

    def read_summary(self, data, start, offsets_start, end):
        groups, found, indexed = {}, {}, set()
        for opcode, content, offset, length in records(data, start, offsets_start):
            require(opcode not in groups or sum(groups[opcode]) == offset, "a summary that is not grouped")
            first, size = groups.get(opcode, (offset, 0))
            groups[opcode] = (first, size + length)
            if opcode in (SCHEMA, CHANNEL):
                key, value = self.definition(opcode, content)
                found[opcode, key] = value
            elif opcode == CHUNK_INDEX:
                indexed.add(self.check_chunk_index(content))
            elif opcode == STATISTICS:
                self.check_statistics(content)
            elif opcode == METADATA_INDEX:
                fields = Fields(content)
                place = fields.take("QQ")
                require(self.metadata[fields.text()][1:] == place, "a metadata index that leads elsewhere")
        offsets = {Fields(content).take("B"): Fields(content[1:]).take("QQ")
                   for _, content, _, _ in records(data, offsets_start, end)}
        require(offsets == groups, "summary offsets")
        require(indexed == set(self.chunks), "a chunk without an index")
        require({SCHEMA, CHANNEL, STATISTICS, CHUNK_INDEX} <= set(groups), "a summary without its parts")
        expected = {(SCHEMA, key): value for key, value in self.schemas.items()}
        expected.update({(CHANNEL, key): value for key, value in self.channels.items()})
        require(found == expected, "schemas and channels of the summary")

    def check_chunk_index(self, content):
        fields = Fields(content)
        first, last, start, length = fields.take("QQQQ")
        chunk = self.chunks[start]
        require((first, last) == chunk["times"] and length == chunk["length"], "a chunk index that leads elsewhere")
        require(dict(fields.pairs("HQ")) == chunk["indexes"], "offsets of message indexes")
        require(set(chunk["indexes"]) == set(chunk["records"]), "a channel without an index")
        require(fields.take("Q") == chunk["index_length"], "length of message indexes")
        require(fields.text() == chunk["compression"], "compression of a chunk")
        require(fields.take("QQ") == (chunk["packed"], chunk["size"]), "sizes of a chunk")
        fields.end()
        return start

    def check_statistics(self, content):
        fields = Fields(content)
        counts = fields.take("QHIIII")
        require(counts == (len(self.messages), len(self.schemas), len(self.channels), 0, len(self.metadata),
                           len(self.chunks)), "counts")
        times = [time for _, time, _ in self.messages]
        require(fields.take("QQ") == (min(times), max(times)), "times of the file")
        require(dict(fields.pairs("HQ")) == {channel: self.sequence.get(channel, 0) for channel in self.channels},
                "counts of channels")
        fields.end()
