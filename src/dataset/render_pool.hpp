/// Objects of a dataset, rendered by several processes.
#pragma once

#include <functional>
#include <vector>

#include "vantage/dataset/object_source.hpp"
#include "vantage/dataset/render_dataset.hpp"

namespace vantage {

/// Renders `names`, `run.jobs` at a time. An object whose process died is rendered again by another
/// one, three times at most.
/// @param done called with the object and its views as each is complete
/// @returns false if `run.stop` ended it; what was begun is removed.
/// @throws RendererError naming an object whose processes died, what a process says it failed by,
/// OutputError
bool render_in_processes(const DatasetOptions& options, const DatasetRun& run,
                         const std::vector<ObjectName>& names,
                         const std::function<void(const ObjectName&, int views)>& done);

}  // namespace vantage
