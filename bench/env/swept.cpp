// The sweep of given views over a given map, for comparison with the same from elsewhere:
// bench_swept MAP.ot VIEWS.csv [REPEATS] prints the median in ms.
#include <fmt/format.h>

#include <cstdlib>

#include "bench/measures.hpp"
#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/planners/views/view_list.hpp"

int main(int argc, char** argv) {
  return vantage::bench::run_main([&] {
    using namespace vantage;
    if (argc < 3) throw ConfigError("usage: bench_swept MAP.ot VIEWS.csv [REPEATS]");
    const OccupancyGrid grid = read_octomap_grid(argv[1]);
    const auto views = read_views(argv[2]);
    const FieldOfView tilting_laser;
    const int repeats = argc > 3 ? std::max(1, std::atoi(argv[3])) : 15;
    fmt::print("{}\n", bench::median_ms(repeats, [&] {
                 view_gains_bits(Gain(BeerLambertGain{}), {grid}, views, tilting_laser, 1);
               }));
  });
}
