#include "vantage/mcap/timeline.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

#include "vantage/mcap/messages.hpp"

namespace vantage {

std::size_t Timeline::add_stream(const std::string& topic, const std::string& foxglove_name) {
  streams.push_back({topic, "foxglove." + foxglove_name, foxglove_schema(foxglove_name).dump()});
  return streams.size() - 1;
}

void Timeline::add(std::size_t stream, double time_s,
                   std::function<nlohmann::ordered_json()> make) {
  messages.push_back({nanoseconds(time_s), stream, std::move(make)});
}

void Timeline::sort() { std::ranges::stable_sort(messages, {}, &TimedMessage::time_ns); }

}  // namespace vantage
