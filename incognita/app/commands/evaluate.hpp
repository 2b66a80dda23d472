// `incognita evaluate`: errors of an estimated trajectory with respect to the true one.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. If it is selected, `job` is set. The job returns 0 on success and 1 if the trajectories
/// cannot be compared (reported on standard error); it throws InputError for an invalid file or option.
CLI::App* add_evaluate(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
