// `incognita run`: the loop, from a scenario.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. When it is given, `job` becomes what it does; the job returns the exit code and may
/// throw InputError or RecordError.
CLI::App* add_run(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
