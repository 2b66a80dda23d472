// `incognita observe`: what can be seen of a system, and what cannot.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. When it is given, `job` becomes what it does; the job returns the exit code and throws
/// InputError for a system or a combination that makes no sense.
CLI::App* add_observe(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
