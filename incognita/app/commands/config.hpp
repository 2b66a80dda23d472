// `incognita config`: lists the settings of a scenario, or checks them.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. If it is selected, `job` is set; the job returns the exit code and may throw InputError.
CLI::App* add_config(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
