/// Messages of several streams, made when their turn comes.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace vantage {

struct Stream {
  std::string topic;
  std::string schema_name;
  std::string schema;  ///< JSON
};

struct TimedMessage {
  std::uint64_t time_ns = 0;
  std::size_t stream = 0;
  std::function<nlohmann::ordered_json()> make;  ///< called in the order of times
};

struct Timeline {
  std::vector<Stream> streams;
  std::vector<TimedMessage> messages;

  /// One of Foxglove's schemas. @return its index
  std::size_t add_stream(const std::string& topic, const std::string& foxglove_name);
  void add(std::size_t stream, double time_s, std::function<nlohmann::ordered_json()> make);
  void sort();  ///< by time; of the same time as they were added
};

}  // namespace vantage
