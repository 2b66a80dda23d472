// `incognita robot`: the robot's side of the link: a simulated robot, or a relay with a watchdog before a real one.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace incognita {

/// Adds the command to the program; `job` is set when it is chosen.
CLI::App* add_robot(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
