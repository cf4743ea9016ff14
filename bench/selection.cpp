// The time a recogniser takes to choose its next view: 326 objects in 8 yaw bins, unknown ones of
// each of 51 categories and of none, seven turns, the dissertation's simple features, all of them
// to be extracted there. And the time it takes to load a model of the flights' features.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <ctime>
#include <vector>

#include "bench/measures.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/planners/objects/object_view_choice.hpp"
#include "vantage/recognition/lean_recogniser.hpp"

namespace vantage::bench {
namespace {

constexpr int kThreads = 2;  ///< of the tables; a decision takes one
constexpr int kObjects = 326;
constexpr int kCategories = 51;
constexpr std::array kDimensions{144, 3, 1000, 308};

ObjectStates database() {
  ObjectStates states;
  for (int c = 0; c < kCategories; ++c) states.categories.push_back(fmt::format("category_{}", c));
  for (int k = 0; k < kObjects; ++k) {
    states.objects.push_back(fmt::format("object_{}", k));
    states.category_of.push_back(k % kCategories);
  }
  return states;
}

ObjectStates with_unknown_hypotheses(ObjectStates states) {
  states.unknown_category = unknown_hypotheses(states);
  return states;
}

/// As training would leave it, of two views a state.
FeatureModel made_up_feature(const Feature& feature, const ObjectStates& states, Rng& rng) {
  const TrainedFeature extractor = train_feature(feature, {}, rng);
  FeatureModel model{.name = std::string(extractor.name()),
                     .statistics = empty_statistics(extractor.dimension(), states.size()),
                     .psi = 0.1,
                     .cost_s = 1e-3,
                     .unknown = UnknownFactors{},
                     .blobs = {{kExtractorBlob, extractor.to_bytes()}}};
  for (int view = 0; view < 2 * states.size(); ++view) {
    add_view(model.statistics, view / 2, Eigen::VectorXf::NullaryExpr(extractor.dimension(), [&] {
               return static_cast<float>(rng.uniform());
             }));
  }
  return model;
}

/// Of a model of the flights' features: file to recogniser, without tables.
double load_ms(Rng& rng) {
  const support::TemporaryDirectory folder;
  RecognitionModel model{.states = database(), .features = {}, .transitions = {}};
  for (const Feature& feature : {Feature(SoftColour{}), Feature(StandingBox{})}) {
    model.features.push_back(made_up_feature(feature, model.states, rng));
  }
  write_recognition_model(model, folder / "made_up.model");
  return median_ms(15, [&] {
    const Recogniser recogniser = load_lean_recogniser(folder / "made_up.model", {});
    expects(recogniser.states.unknown_size() == kCategories + 1, "unknown objects of every kind");
  });
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
  explicit Decision(Rng& rng) : states_(with_unknown_hypotheses(database())) {
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
  std::string configuration = fmt::format("objects: {}\ncategories: {}\ndimensions: [{}]\n",
                                          kObjects, kCategories, fmt::join(kDimensions, ", "));
  const auto time = [&](const ObjectViewChoice& choice) {
    configuration += to_yaml(write_node(choice));
    return decision.time(choice);
  };
  const Time mi = time(MutualInformation{});
  const Time mi_without_tables = decision.time(MutualInformation{}, false);
  const Time le = time(LossOfEntropy{.samples = 64});
  const Time jd = time(JeffreysDivergence{});
  print_figures("selection", kThreads, configuration,
                {{"mi_ms", mi.wall_ms},
                 {"mi_cpu_ms", mi.cpu_ms},
                 {"mi_without_tables_ms", mi_without_tables.wall_ms},
                 {"le_ms", le.wall_ms},
                 {"le_cpu_ms", le.cpu_ms},
                 {"jd_ms", jd.wall_ms},
                 {"jd_cpu_ms", jd.cpu_ms},
                 {"tables_ms", tables.wall_ms},
                 {"tables_cpu_ms", tables.cpu_ms},
                 {"load_ms", load_ms(rng)},
                 {"states", decision.states()}});
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
