// `incognita target`: a target to print, or one cut from a photograph, with the files that `start.target` reads.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. If it is selected, `job` is set. The job returns 0; it throws InputError for an invalid option or photograph.
CLI::App* add_target(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
