// Example 3.7: the car park without anchors, all correlations dropped after every scan with the least trace.
// See car_park.hpp for the drive, its noises and its start.
//
// Measured: the vehicle's largest sigma in either half of the drive, also with the right associations; wrong
// matches. Holds: it is larger in the second half, and there more than twice that with full covariance; some
// association is wrong.
#include "experiments/car_park.hpp"
#include "experiments/common.hpp"

namespace incognita {
namespace {

using car_park::Data;
using car_park::Drive;

/// The largest sigma of the vehicle's position in one half of the drive, m.
double largest(const Drive& d, bool second_half) {
  double most = 0;
  for (std::size_t i = 0; i < d.sigma_m.size(); ++i)
    if ((i >= d.sigma_m.size() / 2) == second_half) most = std::max(most, d.sigma_m[i]);
  return most;
}

Claim unbounded(const Drive& dropped, const Drive& kept, const Data& data) {
  PlanarSlamSettings known = data.settings;
  known.filter.decorrelate = Decorrelation::everything;
  known.association.method = DataAssociationSettings::Method::known;
  known.association.gate_probability = 1 - 1e-9;
  const Drive right = car_park::drive(data, known);
  const auto numbers = [](const Drive& d) {
    return fmt::format(
        "vehicle's largest sigma {:.2f} then {:.2f} m, landmarks {:.2f} m at the end, growing by up to "
        "{:.0f} %",
        largest(d, false), largest(d, true), d.mean_landmark_sigma_m(), 100 * car_park::largest_growth(d));
  };
  return assessed(
      "3.7-unbounded", "Example 3.7, Figure 3.13 (b), (d)",
      "With everything decorrelated the covariances of vehicle and landmarks are unbounded: the vehicle's "
      "largest sigma in the second half of the drive is above that in the first, and more than twice that "
      "with full covariance",
      {.printed = "unbounded",
       .measured = fmt::format("{}; with the right associations: {}; full covariance: {}", numbers(dropped),
                               numbers(right), numbers(kept)),
       .why =
           "much larger than with full covariance, but in 112 s without a trend: every measurement of an old "
           "landmark takes back the inflation. Example 3.6 shows the growth without such measurements"},
      largest(dropped, true) > largest(dropped, false) && largest(dropped, true) > 2 * largest(kept, true));
}

Claim wrong_associations(const Drive& dropped, const Drive& kept) {
  return assessed(
      "3.7-association", "Example 3.7, Figure 3.14",
      "The inflation is so large that detections are associated with wrong landmarks, or with none",
      {.printed = "data association errors",
       .measured = fmt::format("{} of {} matches wrong, {} of {} detections unmatched, {} landmarks for 15 "
                               "beacons; full covariance: {} wrong, {} unmatched, {} landmarks",
                               dropped.wrong, dropped.matched, dropped.detections - dropped.matched,
                               dropped.detections, dropped.landmarks.size(), kept.wrong,
                               kept.detections - kept.matched, kept.landmarks.size())},
      dropped.wrong > kept.wrong || dropped.landmarks.size() > kept.landmarks.size());
}

LedgerEntry run(const ExperimentSettings& settings) {
  return unless_missing(example_3_7, [&] {
    const Data data = car_park::load();
    PlanarSlamSettings s = data.settings;
    s.filter.decorrelate = Decorrelation::everything;
    const Drive dropped = car_park::drive(data, s), kept = car_park::drive(data, data.settings);
    const std::string title = "Car park, no anchors, everything decorrelated, EKF";
    return entry_of(
        example_3_7, settings, {unbounded(dropped, kept, data), wrong_associations(dropped, kept)},
        {car_park::four_frames("fig-3.13", title, dropped), car_park::map("fig-3.14", title, data, dropped)});
  });
}

}  // namespace

const Experiment example_3_7{
    "3.7", "The car park without anchors, everything decorrelated", {"fig-3.13", "fig-3.14"}, run};

}  // namespace incognita
