// `incognita observe`: observability analysis of a system.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. If it is selected, `job` is set; the job returns the exit code and throws InputError for
/// an invalid system or combination of options.
CLI::App* add_observe(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
