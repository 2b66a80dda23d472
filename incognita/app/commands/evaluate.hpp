// `incognita evaluate`: how far an estimated trajectory is from the true one.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. When it is the one asked for, `job` is set to do it: 0 when done, 1 when the
/// trajectories cannot be compared, which is said on standard error; InputError when a file or option is
/// wrong.
CLI::App* add_evaluate(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
