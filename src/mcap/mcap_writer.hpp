/// MCAP files (https://mcap.dev/spec): messages by channel and time in compressed chunks, with an
/// index, checksums and a summary, so that readers seek in them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/core/atomic_file.hpp"

namespace vantage {

/// Visible under its name only after commit(). @throws OutputError, as all of it
class McapWriter {
 public:
  explicit McapWriter(const std::filesystem::path& path);

  /// A stream of JSON messages. Channels of one schema name share the first schema.
  /// @return its id
  std::uint16_t add_channel(const std::string& topic, const std::string& schema_name,
                            std::string_view json_schema);
  void add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view json);
  /// What is known of the file as a whole.
  void add_metadata(const std::string& name, const std::map<std::string, std::string>& entries);
  void commit();

 private:
  struct Channel {
    std::string record;
    std::uint64_t messages = 0;
  };
  struct Times {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    bool any = false;
    void add(std::uint64_t time_ns);
  };
  /// Where messages of one channel are in the open chunk: time and offset.
  using Index = std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>>;

  void write(std::string_view bytes);
  void close_chunk();
  std::map<std::uint16_t, std::uint64_t> write_message_indexes();
  [[nodiscard]] std::string statistics() const;
  [[nodiscard]] std::vector<std::pair<std::uint8_t, std::string>> summary() const;

  GrowingFile file_;
  std::uint64_t offset_ = 0;
  std::uint32_t crc_ = 0;
  std::map<std::string, std::uint16_t> schema_ids_;
  std::vector<std::string> schemas_;  ///< records, in order of their ids from 1
  std::vector<Channel> channels_;     ///< in order of their ids from 1
  std::string chunk_;                 ///< records of the open chunk
  Index chunk_index_;
  Times chunk_times_;
  Times times_;
  std::vector<std::string> chunk_indexes_;     ///< records
  std::vector<std::string> metadata_indexes_;  ///< records
};

}  // namespace vantage
