// `incognita config`: every setting of a scenario, or whether it is in order.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. When it is given, `job` becomes what it does; the job returns the exit code and may
/// throw InputError.
CLI::App* add_config(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
