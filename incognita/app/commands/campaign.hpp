// `incognita campaign`: Monte Carlo runs of the variants of a scenario, and their statistics.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. If it is selected, `job` is set. The job returns 0 when every requested run has ended,
/// including failed ones, and 1 when some are missing because of an interruption or an error outside of the
/// runs; it throws InputError for invalid input, before any run.
CLI::App* add_campaign(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
