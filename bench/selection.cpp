// The time a recogniser takes to choose its next view: 326 objects in 8 yaw bins, seven turns, the
// dissertation's simple features, all of them to be extracted there.
#include <array>
#include <ctime>
#include <vector>

#include "bench/measures.hpp"
#include "vantage/planners/objects/object_view_choice.hpp"

namespace vantage::bench {
namespace {

constexpr int kThreads = 2;  ///< of the tables; a decision takes one
constexpr int kObjects = 326;
constexpr std::array kDimensions{144, 3, 1000, 308};

ObjectStates database() {
  ObjectStates states;
  for (int k = 0; k < kObjects; ++k) states.objects.push_back("object");
  return states;
}

/// Worth four independent dimensions, whatever it has.
ObservationModel made_up_model(int states, int dimensions, Rng& rng) {
  ObservationModel model{.feature = "made up",
                         .mean = Eigen::MatrixXf(dimensions, states),
                         .variance = Eigen::MatrixXf(dimensions, states),
                         .psi = std::min(1.0, 4.0 / dimensions)};
  for (float& mean : model.mean.reshaped()) mean = static_cast<float>(rng.normal());
  for (float& variance : model.variance.reshaped()) {
    variance = static_cast<float>(rng.uniform(0.5, 2.0));
  }
  return model;
}

/// Some hundred states share most of it.
Eigen::VectorXd made_up_belief(int states, Rng& rng) {
  Eigen::VectorXd belief(states);
  for (double& p : belief) p = std::exp(2.5 * rng.normal());
  return belief / belief.sum();
}

struct Time {
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  ///< of all threads
};

/// Medians over `repeats` calls.
template <class Work>
Time median_time(int repeats, Work&& work) {
  std::vector<double> cpu_ms;
  const double wall_ms = median_ms(repeats, [&] {
    const std::clock_t start = std::clock();
    work();
    cpu_ms.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  });
  std::ranges::nth_element(cpu_ms, cpu_ms.begin() + repeats / 2);
  return {wall_ms, cpu_ms[static_cast<std::size_t>(repeats / 2)]};
}

class Decision {
 public:
  explicit Decision(Rng& rng) : states_(database()) {
    for (const int dimensions : kDimensions) {
      models_.push_back(made_up_model(states_.size(), dimensions, rng));
    }
    for (const ObservationModel& model : models_) features_.push_back(&model);
    for (int turn = 1; turn < states_.bins; ++turn) {
      actions_.push_back({.yaw_rad = turn * states_.bin_rad()});
      beliefs_.push_back(made_up_belief(states_.size(), rng));
    }
  }

  [[nodiscard]] int states() const { return states_.size(); }

  Time build_tables() {
    return median_time(1, [&] {
      tables_.bhattacharyya_nats = table(Divergence::bhattacharyya);
      tables_.kullback_leibler_nats = table(Divergence::kullback_leibler);
    });
  }

  [[nodiscard]] Time time(const ObjectViewChoice& choice, bool with_tables = true) const {
    const ObjectViewSituation situation{.database = states_,
                                        .features = features_,
                                        .tables = with_tables ? &tables_ : nullptr,
                                        .actions = actions_,
                                        .predicted_belief = beliefs_};
    return median_time(15, [&] {
      Rng rng(1);
      choose_object_view({.choice = choice}, situation, rng);
    });
  }

 private:
  [[nodiscard]] Eigen::MatrixXf table(Divergence divergence) const {
    Eigen::MatrixXf sum = Eigen::MatrixXf::Zero(states(), states());
    for (const auto& model : models_) sum += divergence_table(divergence, model, kThreads);
    return sum;
  }

  ObjectStates states_;
  std::vector<ObservationModel> models_;
  std::vector<const ObservationModel*> features_;
  std::vector<ObjectViewAction> actions_;
  std::vector<Eigen::VectorXd> beliefs_;
  DivergenceTables tables_;
};

void run_benchmark() {
  Rng rng(1);
  Decision decision(rng);
  const Time tables = decision.build_tables();
  const Time mi = decision.time(MutualInformation{});
  const Time mi_without_tables = decision.time(MutualInformation{}, false);
  const Time le = decision.time(LossOfEntropy{.samples = 64});
  const Time jd = decision.time(JeffreysDivergence{});
  print_figures("selection", kThreads,
                {{"mi_ms", mi.wall_ms},
                 {"mi_cpu_ms", mi.cpu_ms},
                 {"mi_without_tables_ms", mi_without_tables.wall_ms},
                 {"le_ms", le.wall_ms},
                 {"le_cpu_ms", le.cpu_ms},
                 {"jd_ms", jd.wall_ms},
                 {"jd_cpu_ms", jd.cpu_ms},
                 {"tables_ms", tables.wall_ms},
                 {"tables_cpu_ms", tables.cpu_ms},
                 {"states", decision.states()}});
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
