// `incognita adjust`: bundle adjustment of a whole run.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. If it is selected, `job` is set. The job returns 0 on success and 1 if the matches do not determine the
/// views; it throws InputError for an invalid run directory or option.
CLI::App* add_adjust(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
