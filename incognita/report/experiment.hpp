// What every experiment of the laboratory is: a function from where to write and how many runs to make, to an
// entry of the claims ledger. One short file per example of the thesis.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "incognita/report/ledger.hpp"

namespace incognita {

struct ExperimentSettings {
  std::filesystem::path out;                     ///< folder for figures and their data; exists
  int seeds = 200;                               ///< independent runs behind each claim about chance
  std::function<void(const std::string&)> tell;  ///< progress, a line at a time; may be empty
};

struct Experiment {
  std::string id;  ///< `3.1`, or `text-3` for claims made outside examples
  std::string title;
  std::vector<std::string> figures;  ///< ids of the figures it draws, e.g. `fig-3.4`
  LedgerEntry (*run)(const ExperimentSettings& settings);
  /// Takes so long that tests run it with few seeds and compare all but what depends on how many.
  bool costly = false;
};

/// All of them, in the thesis' order.
const std::vector<Experiment>& all_experiments();

}  // namespace incognita
