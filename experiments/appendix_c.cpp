// Appendix C: the implementation of monocular SLAM, what of it is claimed and can be tested without whole runs on
// images (those are in appendix_c_runs.cpp). Plans are at the heads of appendix_c_*.cpp.
#include "experiments/appendix_c.hpp"

#include "experiments/common.hpp"

namespace incognita {
namespace {

LedgerEntry run_appendix_c(const ExperimentSettings& settings) {
  const int rooms = (settings.seeds + 9) / 10;
  return entry_of(appendix_c_claims, settings,
                  {appendix_c::view_claims(rooms), appendix_c::search_claims(), appendix_c::cost_claims(),
                   appendix_c::mismatch_claims(rooms)});
}

}  // namespace

const Experiment appendix_c_claims{"C", "Appendix C: features, searches and their cost", {}, run_appendix_c};

}  // namespace incognita
