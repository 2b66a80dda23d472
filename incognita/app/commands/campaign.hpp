// `incognita campaign`: many seeds of many variants of a scenario, and what they say together.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. When it is the one asked for, `job` is set to do it: 0 when every run asked for has
/// ended, those that failed included; 1 when some are missing, because it was interrupted or something
/// outside of the runs went wrong; InputError before any run for what makes no sense.
CLI::App* add_campaign(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
