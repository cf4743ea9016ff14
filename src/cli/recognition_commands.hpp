/// `vantage train`, `vantage recognise` and `vantage evaluate`.
#pragma once

#include <functional>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

std::function<ExitCode()> declare_train(CLI::App& app);
std::function<ExitCode()> declare_recognise(CLI::App& app);
std::function<ExitCode()> declare_evaluate(CLI::App& app);

}  // namespace vantage
