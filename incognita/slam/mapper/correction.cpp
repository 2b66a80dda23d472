#include "incognita/slam/mapper/correction.hpp"

#include <set>

#include "incognita/belief/iterated_update.hpp"
#include "incognita/slam/mapper/invariant_errors.hpp"

namespace incognita {
namespace {

/// The blocks that the measurements depend on, each once.
std::vector<BlockId> blocks_of(std::span<const LinearizedMeasurement> measurements) {
  std::set<BlockId> blocks;
  for (const LinearizedMeasurement& measurement : measurements)
    for (int i = 0; i < measurement.part_count; ++i)
      blocks.insert(measurement.parts[static_cast<std::size_t>(i)].block);
  return {blocks.begin(), blocks.end()};
}

void iterate(Estimate& e, std::span<const LinearizedMeasurement> measurements,
             const Relinearize& relinearize) {
  const IterationSettings until{.max_iterations = 20, .tolerance_sigmas = 1e-3};
  const IterationReport report = update_iterated(e.belief, blocks_of(measurements), relinearize, until);
  e.last.update = report.update;
  e.last.iterations = report.iterations;
}

}  // namespace

bool correct(Estimate& e, std::span<const LinearizedMeasurement> measurements, const Relinearize& relinearize,
             const EstimatorSettings& settings) {
  if (measurements.empty()) return false;
  const bool invariant = settings.filter.linearization == Linearization::invariant;
  const BlockId body = e.bodies.front().block;
  const SmallVector before = invariant ? SmallVector(e.belief.mean(body)) : SmallVector();
  if (settings.filter.linearization == Linearization::iterated)
    iterate(e, measurements, relinearize);
  else
    e.last.update = e.belief.update(measurements);
  const bool done = e.last.update.outcome == UpdateReport::Outcome::updated;
  if (done && invariant) keep_errors_invariant(e, body, before);
  e.last.refused = e.last.refused || e.last.update.outcome == UpdateReport::Outcome::singular;
  constexpr double forgetting = 0.9;
  e.health.recent_nis = forgetting * e.health.recent_nis + (done ? e.last.update.nis : 0);
  e.health.recent_rows = forgetting * e.health.recent_rows + (done ? e.last.update.rows : 0);
  return done;
}

}  // namespace incognita
