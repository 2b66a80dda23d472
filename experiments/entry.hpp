// An experiment's entry of the ledger, from its claims and plots.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <utility>
#include <vector>

#include "experiments/curves.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/report/experiment.hpp"
#include "incognita/report/plot.hpp"

namespace incognita {

/// A claim, or the claims of a part of an experiment.
struct ClaimPart {
  std::vector<Claim> claims;
  ClaimPart(Claim one) : claims{std::move(one)} {}
  ClaimPart(std::vector<Claim> many) : claims(std::move(many)) {}
};

/// Claims of several parts of an experiment, in this order.
inline std::vector<Claim> concatenated(std::initializer_list<ClaimPart> parts) {
  std::vector<Claim> all;
  for (const ClaimPart& part : parts) std::ranges::copy(part.claims, std::back_inserter(all));
  return all;
}

/// Draws the plots into the output folder, thinned().
inline LedgerEntry entry_of(const Experiment& experiment, const ExperimentSettings& settings,
                            std::initializer_list<ClaimPart> parts, const std::vector<Plot>& plots = {}) {
  LedgerEntry entry{experiment.id, experiment.title, "", concatenated(parts), {}};
  for (const Plot& plot : plots) entry.figures.push_back(draw_plot(settings.out, thinned(plot), nullptr));
  return entry;
}

/// The entry that `make` makes of what is loaded; or that it was skipped, and why, where there is no recording.
template <class Load, class Make>
LedgerEntry unless_missing(const Experiment& experiment, const Load& load, const Make& make) {
  try {
    return make(load());
  } catch (const InputError& error) {
    return {experiment.id, experiment.title, error.what(), {}, {}};
  }
}

}  // namespace incognita
