// `incognita run`: runs the loop of a scenario.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. If it is selected, `job` is set; the job returns the exit code and may throw InputError
/// or RecordError.
CLI::App* add_run(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
