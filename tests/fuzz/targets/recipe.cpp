// The recipe of a model.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/recipe/model_recipe.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  read_model_recipe(folder.put("recipe.yaml", bytes));
}

}  // namespace vantage::fuzz
