/// Reads an MCAP file by its specification alone and expects it to keep what it promises:
/// checksums, index, summary, counts.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>
#include <zstd.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "vantage/core/bytes.hpp"

namespace vantage::test {

struct McapRecord {
  int op = 0;
  std::string content;
  std::size_t offset = 0;  ///< of its first byte
  std::size_t length = 0;
};

inline std::vector<McapRecord> records_in(std::string_view data, std::size_t begin,
                                          std::size_t end) {
  std::vector<McapRecord> found;
  while (begin < end) {
    ByteReader reader(data.substr(begin, end - begin), "mcap");
    const int op = reader.number<std::uint8_t>("a kind");
    const auto size = reader.number<std::uint64_t>("a size");
    found.push_back({op, std::string(reader.block(size, "a record")), begin, 9 + size});
    begin += found.back().length;
  }
  return found;
}

inline std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

struct McapMessage {
  int channel = 0;
  std::uint64_t time_ns = 0;
  std::string text;
};

struct McapChunk {
  std::size_t length = 0;
  std::pair<std::uint64_t, std::uint64_t> times{};
  std::size_t size = 0;
  std::size_t packed = 0;
  std::size_t messages = 0;
  std::map<int, std::vector<std::pair<std::uint64_t, std::uint64_t>>> places;  ///< of messages
  std::map<int, std::size_t> indexes;                                          ///< offsets
  std::size_t index_length = 0;
};

class McapFile {
 public:
  std::map<int, std::pair<std::string, std::string>> schemas;  ///< name, JSON
  std::map<int, std::pair<std::string, int>> channels;         ///< topic, schema
  std::vector<McapMessage> messages;                           ///< in the order of the file
  std::map<std::string, std::map<std::string, std::string>> metadata;
  std::vector<McapChunk> chunks;

  explicit McapFile(const std::string& data) : data_(data) {
    EXPECT_EQ(data.substr(0, 8), kMagic);
    EXPECT_EQ(data.substr(data.size() - 8), kMagic);
    const std::size_t footer_at = data.size() - 8 - 29;
    const McapRecord footer = records_in(data, footer_at, data.size() - 8).at(0);
    EXPECT_EQ(footer.op, 2);
    ByteReader fields(footer.content, "footer");
    const auto summary_at = fields.number<std::uint64_t>("summary");
    const auto offsets_at = fields.number<std::uint64_t>("offsets");
    EXPECT_EQ(fields.number<std::uint32_t>("checksum"),
              checksum(std::string_view(data).substr(summary_at, data.size() - 12 - summary_at)));
    read_data(summary_at);
    read_summary(summary_at, offsets_at, footer_at);
  }

 private:
  static inline const std::string kMagic{"\x89MCAP0\r\n"};

  void read_data(std::size_t end) {
    const auto records = records_in(data_, 8, end);
    EXPECT_EQ(records.front().op, 1);
    ByteReader header(records.front().content, "header");
    EXPECT_EQ(header.text("profile"), "");
    EXPECT_EQ(header.text("library"), "vantage");
    header.finish();
    EXPECT_EQ(records.back().op, 15);
    EXPECT_EQ(ByteReader(records.back().content, "end").number<std::uint32_t>("checksum"),
              checksum(std::string_view(data_).substr(0, records.back().offset)));
    for (std::size_t i = 1; i + 1 < records.size(); ++i) {
      ByteReader fields(records[i].content, "record");
      if (records[i].op == 6) {
        chunk_at_[records[i].offset] = chunks.size();
        read_chunk(fields, records[i].length);
      } else if (records[i].op == 7) {
        const int channel = fields.number<std::uint16_t>("channel");
        EXPECT_EQ((pairs<std::uint64_t, std::uint64_t>(fields)), chunks.back().places[channel]);
        chunks.back().indexes[channel] = records[i].offset;
        chunks.back().index_length += records[i].length;
      } else {
        EXPECT_EQ(records[i].op, 12);
        const std::string name = fields.text("name");
        metadata_at_[name] = {records[i].offset, records[i].length};
        metadata[name] = {};
        const std::string entries = fields.text("entries");
        for (ByteReader entry(entries, "entries"); entry.left() > 0;) {
          const std::string key = entry.text("key");
          metadata[name][key] = entry.text("value");
        }
      }
    }
  }

  template <class A, class B>
  static std::vector<std::pair<A, B>> pairs(ByteReader& fields) {
    const std::string all = fields.text("pairs");
    std::vector<std::pair<A, B>> found;
    for (ByteReader pair(all, "pairs"); pair.left() > 0;) {
      const A first = pair.number<A>("first");
      found.emplace_back(first, pair.number<B>("second"));
    }
    return found;
  }

  void read_chunk(ByteReader& fields, std::size_t length) {
    McapChunk& chunk = chunks.emplace_back();
    chunk.length = length;
    chunk.times.first = fields.number<std::uint64_t>("first");
    chunk.times.second = fields.number<std::uint64_t>("last");
    chunk.size = fields.number<std::uint64_t>("size");
    const auto crc = fields.number<std::uint32_t>("checksum");
    EXPECT_EQ(fields.text("compression"), "zstd");
    chunk.packed = fields.number<std::uint64_t>("packed");
    const std::string_view packed = fields.block(chunk.packed, "bytes");
    fields.finish();
    std::string inside(chunk.size, '\0');
    EXPECT_EQ(ZSTD_decompress(inside.data(), inside.size(), packed.data(), packed.size()),
              chunk.size);
    EXPECT_EQ(checksum(inside), crc);
    std::string again(ZSTD_compressBound(inside.size()), '\0');
    again.resize(ZSTD_compress(again.data(), again.size(), inside.data(), inside.size(), kLevel));
    EXPECT_EQ(again.size(), packed.size());
    std::pair<std::uint64_t, std::uint64_t> times{~0ULL, 0};
    for (const McapRecord& record : records_in(inside, 0, inside.size())) {
      if (record.op != 5) {
        read_definition(record);
        continue;
      }
      const std::uint64_t time_ns = read_message(record, chunk);
      times = {std::min(times.first, time_ns), std::max(times.second, time_ns)};
    }
    if (chunk.messages > 0) {
      EXPECT_EQ(chunk.times, times);
    }
  }

  std::uint64_t read_message(const McapRecord& record, McapChunk& chunk) {
    ByteReader fields(record.content, "message");
    const int channel = fields.number<std::uint16_t>("channel");
    EXPECT_TRUE(channels.contains(channel));
    EXPECT_EQ(fields.number<std::uint32_t>("sequence"), sequence_[channel]++);
    const auto time_ns = fields.number<std::uint64_t>("logged");
    EXPECT_EQ(fields.number<std::uint64_t>("published"), time_ns);
    messages.push_back({channel, time_ns, std::string(fields.block(fields.left(), "text"))});
    chunk.places[channel].emplace_back(time_ns, record.offset);
    ++chunk.messages;
    return time_ns;
  }

  void read_definition(const McapRecord& record) {
    ByteReader fields(record.content, "definition");
    const int id = fields.number<std::uint16_t>("id");
    if (record.op == 3) {
      const std::string name = fields.text("name");
      EXPECT_EQ(fields.text("encoding"), "jsonschema");
      EXPECT_TRUE(schemas.emplace(id, std::pair(name, fields.text("data"))).second);
    } else {
      EXPECT_EQ(record.op, 4);
      const int schema = fields.number<std::uint16_t>("schema");
      EXPECT_TRUE(schemas.contains(schema));
      EXPECT_TRUE(channels.emplace(id, std::pair(fields.text("topic"), schema)).second);
      EXPECT_EQ(fields.text("encoding"), "json");
      EXPECT_EQ(fields.text("metadata"), "");
    }
    fields.finish();
    definitions_[{record.op, id}] = record.content;
  }

  void read_summary(std::size_t begin, std::size_t offsets_at, std::size_t end) {
    std::map<int, std::pair<std::uint64_t, std::uint64_t>> groups;
    std::map<std::pair<int, int>, std::string> told;
    std::size_t indexed = 0;
    std::size_t described = 0;
    for (const McapRecord& record : records_in(data_, begin, offsets_at)) {
      auto& [first, size] = groups.try_emplace(record.op, record.offset, 0).first->second;
      EXPECT_EQ(first + size, record.offset) << "one group of each kind";
      size += record.length;
      ByteReader fields(record.content, "summary");
      if (record.op == 3 || record.op == 4) {
        told[{record.op, fields.number<std::uint16_t>("id")}] = record.content;
      } else if (record.op == 8) {
        check_chunk_index(fields);
        ++indexed;
      } else if (record.op == 11) {
        check_statistics(fields);
      } else {
        EXPECT_EQ(record.op, 13);
        const auto at = fields.number<std::uint64_t>("offset");
        const auto length = fields.number<std::uint64_t>("length");
        EXPECT_EQ(std::pair(at, length), metadata_at_.at(fields.text("name")));
        ++described;
      }
    }
    EXPECT_EQ(told, definitions_);
    EXPECT_EQ(indexed, chunks.size());
    EXPECT_EQ(described, metadata.size());
    std::map<int, std::pair<std::uint64_t, std::uint64_t>> offsets;
    for (const McapRecord& record : records_in(data_, offsets_at, end)) {
      EXPECT_EQ(record.op, 14);
      ByteReader fields(record.content, "offset");
      const int op = fields.number<std::uint8_t>("kind");
      const auto start = fields.number<std::uint64_t>("start");
      offsets[op] = {start, fields.number<std::uint64_t>("length")};
    }
    EXPECT_EQ(offsets, groups);
  }

  void check_chunk_index(ByteReader& fields) {
    const auto first = fields.number<std::uint64_t>("first");
    const auto last = fields.number<std::uint64_t>("last");
    const McapChunk& chunk = chunks.at(chunk_at_.at(fields.number<std::uint64_t>("start")));
    EXPECT_EQ(std::pair(first, last), chunk.times);
    EXPECT_EQ(fields.number<std::uint64_t>("length"), chunk.length);
    std::map<int, std::size_t> indexes;
    for (const auto& [channel, at] : pairs<std::uint16_t, std::uint64_t>(fields)) {
      indexes[channel] = at;
    }
    EXPECT_EQ(indexes, chunk.indexes);
    EXPECT_EQ(indexes.size(), chunk.places.size());
    EXPECT_EQ(fields.number<std::uint64_t>("index length"), chunk.index_length);
    EXPECT_EQ(fields.text("compression"), "zstd");
    EXPECT_EQ(fields.number<std::uint64_t>("packed"), chunk.packed);
    EXPECT_EQ(fields.number<std::uint64_t>("size"), chunk.size);
    fields.finish();
  }

  void check_statistics(ByteReader& fields) {
    EXPECT_EQ(fields.number<std::uint64_t>("messages"), messages.size());
    EXPECT_EQ(fields.number<std::uint16_t>("schemas"), schemas.size());
    EXPECT_EQ(fields.number<std::uint32_t>("channels"), channels.size());
    EXPECT_EQ(fields.number<std::uint32_t>("attachments"), 0U);
    EXPECT_EQ(fields.number<std::uint32_t>("metadata"), metadata.size());
    EXPECT_EQ(fields.number<std::uint32_t>("chunks"), chunks.size());
    std::pair<std::uint64_t, std::uint64_t> times{messages.empty() ? 0 : ~0ULL, 0};
    for (const McapMessage& message : messages) {
      times = {std::min(times.first, message.time_ns), std::max(times.second, message.time_ns)};
    }
    EXPECT_EQ(fields.number<std::uint64_t>("first"), times.first);
    EXPECT_EQ(fields.number<std::uint64_t>("last"), times.second);
    const auto counts = pairs<std::uint16_t, std::uint64_t>(fields);
    EXPECT_EQ(counts.size(), channels.size());
    for (const auto& [channel, count] : counts) EXPECT_EQ(count, sequence_[channel]) << channel;
    fields.finish();
  }

  static constexpr int kLevel = 3;
  std::string data_;
  std::map<std::size_t, std::size_t> chunk_at_;  ///< which chunk begins there
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> metadata_at_;
  std::map<int, std::uint32_t> sequence_;
  std::map<std::pair<int, int>, std::string> definitions_;  ///< by kind and id
};

}  // namespace vantage::test
