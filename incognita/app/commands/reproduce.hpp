// `incognita reproduce`: repeats the examples and figures of the thesis and checks their claims.
#pragma once

#include <functional>
#include <vector>

#include "incognita/report/experiment.hpp"

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. If it is selected, `job` is set. The job returns 0 if all requested experiments ran,
/// whatever the verdicts, and 1 if one failed (the others are run nevertheless); it throws InputError for an
/// unknown example or figure and RecordError if the ledger cannot be written. `experiments` must outlive the job.
CLI::App* add_reproduce(CLI::App& app, std::function<int()>& job, const std::vector<Experiment>& experiments);

}  // namespace incognita
