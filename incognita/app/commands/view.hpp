// `incognita view`: recorded runs, claims and campaigns in the browser.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace incognita {

/// Adds the command to the program; `job` is set when it is chosen.
CLI::App* add_view(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
