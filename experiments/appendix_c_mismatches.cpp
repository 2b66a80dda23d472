// What mismatches do to the filter: Appendix C.4.
//
// Experiment: scenarios/free-camera.toml, identities given, gaze by (i), 35 s, 20 rooms. In one frame of twenty two
// measurements of mapped features exchange their identities, as if two features resembled each other. The plan, written
// before the runs: a catastrophic failure is a run that ends lost or with a position error above 0.5 m (rms); mismatches
// can lead to it if more rooms fail with than without them.
#include "experiments/appendix_c.hpp"
#include "experiments/common.hpp"
#include "experiments/exploring_comparison.hpp"
#include "incognita/app/loop/assembly.hpp"

namespace incognita::appendix_c {
namespace {

using exploring::Runs;

constexpr int one_frame_of = 20;

/// Exchanges the identities of the first two detections in one frame of `one_frame_of`.
class Mismatching final : public Sensor {
 public:
  Mismatching(std::unique_ptr<Sensor> sensors, std::uint64_t seed)
      : sensors_(std::move(sensors)), random_(seed, "mismatches") {}

  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override {
    Observation observation = sensors_->measure(truth, tick);
    std::vector<PointDetection>& seen = observation.bodies.front().landmarks;
    if (random_.below(one_frame_of) == 0 && seen.size() > 1) std::swap(seen[0].identity, seen[1].identity);
    return observation;
  }

 private:
  std::unique_ptr<Sensor> sensors_;
  RandomStream random_;
};

Runs runs_with(bool mismatches, int rooms) {
  return {over_seeds(rooms,
                     [&](std::uint64_t seed) {
                       return exploring::explore(
                           "free-camera", {"decision.gaze=constant-rate", "decision.schedule=at-decisions"},
                           seed, [&](Assembly& assembly) {
                             auto& sensor = assembly.parts.sensor;
                             if (mismatches) sensor = std::make_unique<Mismatching>(std::move(sensor), seed);
                           });
                     }),
          mismatches ? "with" : "without"};
}

}  // namespace

std::vector<Claim> mismatch_claims(int rooms) {
  const Runs without = runs_with(false, rooms), with = runs_with(true, rooms);
  const auto failed = [](const exploring::Run& run) { return exploring::diverged(run) ? 1.0 : 0.0; };
  const Interval more = bootstrap_mean(less(each(with, failed), each(without, failed)));
  return {assessed(
      "C.4-mismatches", "Appendix C.4",
      "Mismatches can lead to catastrophic failure: with two features exchanged in one frame of twenty "
      "more rooms end lost or with an error above 0.5 m than without",
      {.rule = Rule::superiority,
       .measured = {"{} of {} rooms, {} without; median error {} m, {} without", exploring::diverged_of(with),
                    with.size(), exploring::diverged_of(without),
                    decimals(exploring::median_known(each(with, &exploring::Run::position_rms_m)).value, 2),
                    decimals(exploring::median_known(each(without, &exploring::Run::position_rms_m)).value,
                             2)},
       .number = ClaimNumber{"share of rooms that fail by mismatches", more},
       .seeds = rooms},
      is_above(more, 0))};
}

}  // namespace incognita::appendix_c
