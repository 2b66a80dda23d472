// An experiment of the laboratory: a function from an output folder and a number of runs to an entry of the
// claims ledger. Each example of the thesis has one.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "incognita/report/ledger.hpp"

namespace incognita {

struct ExperimentSettings {
  std::filesystem::path out;                       ///< existing folder for figures and their data
  int seeds = 200;                                 ///< independent runs for each statistical claim
  std::function<void(const std::string&)> report;  ///< receives progress lines; may be empty
};

struct Experiment {
  std::string id;  ///< `3.1`, or `text-3` for claims outside of examples
  std::string title;
  std::vector<std::string> figures;  ///< ids of its figures, e.g. `fig-3.4`
  LedgerEntry (*run)(const ExperimentSettings& settings);
  /// Tests run a costly experiment with few seeds and skip the claims that depend on their number.
  bool costly = false;
};

/// All experiments in the order of the thesis.
const std::vector<Experiment>& all_experiments();

}  // namespace incognita
