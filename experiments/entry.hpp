// An experiment's entry of the ledger, from its claims and plots.
#pragma once

#include <iterator>
#include <utility>
#include <vector>

#include "incognita/messages/errors.hpp"
#include "incognita/report/experiment.hpp"
#include "incognita/report/plot.hpp"

namespace incognita {

/// Draws the plots into the output folder.
inline LedgerEntry entry_of(const Experiment& experiment, const ExperimentSettings& settings,
                            std::vector<Claim> claims, const std::vector<Plot>& plots = {}) {
  LedgerEntry entry{experiment.id, experiment.title, "", std::move(claims), {}};
  for (const Plot& plot : plots) entry.figures.push_back(draw_plot(settings.out, plot, nullptr));
  return entry;
}

/// The entry that `make` returns; or that it was skipped, and why, where `make` finds no recording.
template <class Make>
LedgerEntry unless_missing(const Experiment& experiment, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    return {experiment.id, experiment.title, error.what(), {}, {}};
  }
}

/// Claims of several parts of an experiment, in this order.
inline std::vector<Claim> concatenated(std::vector<std::vector<Claim>> parts) {
  std::vector<Claim> all;
  for (std::vector<Claim>& part : parts) std::move(part.begin(), part.end(), std::back_inserter(all));
  return all;
}

}  // namespace incognita
