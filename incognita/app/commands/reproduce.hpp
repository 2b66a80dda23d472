// `incognita reproduce`: the thesis' examples and figures again, each with its claims checked.
#pragma once

#include <functional>
#include <vector>

#include "incognita/report/experiment.hpp"

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. When it is the one asked for, `job` is set to do it: 0 when all that was asked for ran,
/// whatever the verdicts, 1 when an experiment failed (the others run all the same); InputError when there is
/// no such example or figure, RecordError when the ledger cannot be written. `experiments` must outlive the
/// job.
CLI::App* add_reproduce(CLI::App& app, std::function<int()>& job, const std::vector<Experiment>& experiments);

}  // namespace incognita
