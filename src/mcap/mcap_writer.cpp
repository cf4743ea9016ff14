#include "vantage/mcap/mcap_writer.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>

#include "vantage/core/bytes.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "\x89MCAP0\r\n"sv;
constexpr std::string_view kCompression = "zstd";
constexpr int kCompressionLevel = 3;
constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

enum class Op : std::uint8_t {
  header = 1,
  footer,
  schema,
  channel,
  message,
  chunk,
  message_index,
  chunk_index,
  statistics = 11,
  metadata,
  metadata_index,
  summary_offset,
  data_end
};

std::uint32_t crc_of(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string record(Op op, std::string_view content) {
  std::string bytes;
  put(bytes, static_cast<std::uint8_t>(op));
  put(bytes, static_cast<std::uint64_t>(content.size()));
  bytes.append(content);
  return bytes;
}

/// Maps and arrays stand after their size in bytes, as texts do.
template <class Key, class Value>
std::string packed(const std::map<Key, Value>& entries) {
  std::string bytes;
  for (const auto& [key, value] : entries) {
    if constexpr (std::is_arithmetic_v<Key>) {
      put(bytes, key);
      put(bytes, value);
    } else {
      put_text(bytes, key);
      put_text(bytes, value);
    }
  }
  return bytes;
}

std::string compressed(std::string_view bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kCompressionLevel);
  expects(ZSTD_isError(size) == 0, "zstd compresses into a buffer that is large enough");
  out.resize(size);
  return out;
}

}  // namespace

void McapWriter::Times::add(std::uint64_t time_ns) {
  first_ns = any ? std::min(first_ns, time_ns) : time_ns;
  last_ns = any ? std::max(last_ns, time_ns) : time_ns;
  any = true;
}

McapWriter::McapWriter(const std::filesystem::path& path) : file_(path) {
  std::string content;
  put_text(content, "");
  put_text(content, "vantage");
  write(kMagic);
  write(record(Op::header, content));
}

void McapWriter::write(std::string_view bytes) {
  file_.write(bytes);
  offset_ += bytes.size();
  crc_ = crc_of(bytes, crc_);
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const std::string& schema_name,
                                      std::string_view json_schema) {
  const auto [schema, is_new] =
      schema_ids_.emplace(schema_name, static_cast<std::uint16_t>(schemas_.size() + 1));
  if (is_new) {
    std::string content;
    put(content, schema->second);
    put_text(content, schema_name);
    put_text(content, "jsonschema");
    put_text(content, json_schema);
    schemas_.push_back(record(Op::schema, content));
    chunk_ += schemas_.back();
  }
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  std::string content;
  put(content, id);
  put(content, schema->second);
  put_text(content, topic);
  put_text(content, "json");
  put_text(content, "");
  channels_.push_back({record(Op::channel, content)});
  chunk_ += channels_.back().record;
  return id;
}

void McapWriter::add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view json) {
  expects(channel > 0 && channel <= channels_.size(), "a channel of this file");
  std::string content;
  put(content, channel);
  put(content, static_cast<std::uint32_t>(channels_[channel - 1U].messages++));
  put(content, time_ns);
  put(content, time_ns);
  content.append(json);
  chunk_index_[channel].emplace_back(time_ns, chunk_.size());
  chunk_times_.add(time_ns);
  times_.add(time_ns);
  chunk_ += record(Op::message, content);
  if (chunk_.size() >= kChunkBytes) close_chunk();
}

void McapWriter::add_metadata(const std::string& name,
                              const std::map<std::string, std::string>& entries) {
  close_chunk();
  std::string content;
  put_text(content, name);
  put_text(content, packed(entries));
  const std::string bytes = record(Op::metadata, content);
  std::string index;
  put(index, offset_);
  put(index, static_cast<std::uint64_t>(bytes.size()));
  put_text(index, name);
  metadata_indexes_.push_back(record(Op::metadata_index, index));
  write(bytes);
}

std::map<std::uint16_t, std::uint64_t> McapWriter::write_message_indexes() {
  std::map<std::uint16_t, std::uint64_t> offsets;
  for (const auto& [channel, entries] : chunk_index_) {
    std::string places;
    for (const auto& [time_ns, offset] : entries) {
      put(places, time_ns);
      put(places, offset);
    }
    std::string content;
    put(content, channel);
    put_text(content, places);
    offsets[channel] = offset_;
    write(record(Op::message_index, content));
  }
  return offsets;
}

void McapWriter::close_chunk() {
  if (chunk_.empty()) return;
  const std::string packed_records = compressed(chunk_);
  std::string content;
  put(content, chunk_times_.first_ns);
  put(content, chunk_times_.last_ns);
  put(content, static_cast<std::uint64_t>(chunk_.size()));
  put(content, crc_of(chunk_));
  put_text(content, kCompression);
  put(content, static_cast<std::uint64_t>(packed_records.size()));
  content += packed_records;
  const std::uint64_t start = offset_;
  write(record(Op::chunk, content));
  const std::uint64_t end = offset_;
  const auto offsets = write_message_indexes();
  std::string index;
  put(index, chunk_times_.first_ns);
  put(index, chunk_times_.last_ns);
  put(index, start);
  put(index, end - start);
  put_text(index, packed(offsets));
  put(index, offset_ - end);
  put_text(index, kCompression);
  put(index, static_cast<std::uint64_t>(packed_records.size()));
  put(index, static_cast<std::uint64_t>(chunk_.size()));
  chunk_indexes_.push_back(record(Op::chunk_index, index));
  chunk_.clear();
  chunk_index_.clear();
  chunk_times_ = {};
}

std::string McapWriter::statistics() const {
  std::map<std::uint16_t, std::uint64_t> counts;
  std::uint64_t messages = 0;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    counts[static_cast<std::uint16_t>(i + 1)] = channels_[i].messages;
    messages += channels_[i].messages;
  }
  std::string content;
  put(content, messages);
  put(content, static_cast<std::uint16_t>(schemas_.size()));
  put(content, static_cast<std::uint32_t>(channels_.size()));
  put(content, std::uint32_t{0});  // attachments
  put(content, static_cast<std::uint32_t>(metadata_indexes_.size()));
  put(content, static_cast<std::uint32_t>(chunk_indexes_.size()));
  put(content, times_.first_ns);
  put(content, times_.last_ns);
  put_text(content, packed(counts));
  return record(Op::statistics, content);
}

/// Records of one kind each, with their kind.
std::vector<std::pair<std::uint8_t, std::string>> McapWriter::summary() const {
  std::vector<std::pair<std::uint8_t, std::string>> groups;
  const auto add = [&](Op op, std::string bytes) {
    if (!bytes.empty()) groups.emplace_back(static_cast<std::uint8_t>(op), std::move(bytes));
  };
  const auto joined = [](const std::vector<std::string>& records) {
    std::string bytes;
    for (const std::string& one : records) bytes += one;
    return bytes;
  };
  std::string channels;
  for (const Channel& channel : channels_) channels += channel.record;
  add(Op::schema, joined(schemas_));
  add(Op::channel, channels);
  add(Op::statistics, statistics());
  add(Op::chunk_index, joined(chunk_indexes_));
  add(Op::metadata_index, joined(metadata_indexes_));
  return groups;
}

void McapWriter::commit() {
  close_chunk();
  std::string content;
  put(content, crc_);
  write(record(Op::data_end, content));
  const std::uint64_t summary_start = offset_;
  std::string tail;
  std::string offsets;
  for (const auto& [op, bytes] : summary()) {
    std::string place;
    put(place, op);
    put(place, summary_start + tail.size());
    put(place, static_cast<std::uint64_t>(bytes.size()));
    offsets += record(Op::summary_offset, place);
    tail += bytes;
  }
  const std::uint64_t offsets_start = summary_start + tail.size();
  tail += offsets;
  std::string footer;
  put(footer, summary_start);
  put(footer, offsets_start);
  put(footer, std::uint32_t{0});
  std::string bytes = record(Op::footer, footer);
  bytes.resize(bytes.size() - sizeof(std::uint32_t));  // what its checksum is of as well
  tail += bytes;
  const std::uint32_t crc = crc_of(tail);
  put(tail, crc);
  write(tail);
  write(kMagic);
  file_.commit();
}

}  // namespace vantage
