// The recorded car park; skipped, with the reason, without the recording.
#include <gtest/gtest.h>

#include <cstdio>

#include "incognita/analysis/evaluation/map_error.hpp"
#include "incognita/app/loop/assembly.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

struct Outcome {
  std::vector<Eigen::Vector2d> landmarks, path, gps, beacons;
  int lost = 0;
};

/// The first 112 s.
Outcome drive(const std::string& scenario, std::vector<std::string> sets = {}) {
  sets.push_back("run.duration_s=112");
  Assembly assembly = assemble(load_scenario(scenario, sets));
  auto& [clock, world, sensor, estimator, decision, controller, map_truth] = assembly.parts;
  Estimate estimate;
  Outcome out;
  while (const Tick tick = clock->next()) {
    estimator->update(estimate, {}, sensor->measure({}, tick), tick);
    out.lost += estimate.status.state == TrackingState::lost;
    const auto truth = true_position(assembly.recordings->front(), tick.t);
    if (!truth || !estimate.started) continue;
    out.path.emplace_back(estimate.bodies.front().state.head<2>());
    out.gps.push_back(truth->position);
  }
  for (const auto& [id, landmark] : estimate.landmarks)
    if (!landmark.fixed) out.landmarks.emplace_back(position_of(landmark, estimate)->position);
  for (const auto& beacon : assembly.recordings->front().landmarks) {
    bool anchor = false;
    for (const auto& [id, landmark] : estimate.landmarks)
      anchor |= landmark.fixed && (Eigen::Vector2d(landmark.position) - beacon.position).norm() < 0.01;
    if (!anchor) out.beacons.push_back(beacon.position);
  }
  return out;
}

double rms(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

#define SKIP_WITHOUT_RECORDING(statement) \
  try {                                   \
    statement;                            \
  } catch (const InputError& error) {     \
    GTEST_SKIP() << error.what();         \
  }

TEST(CarPark, WithTwoAnchorsTheMapAgreesWithTheSurvey) {
  Outcome out;
  SKIP_WITHOUT_RECORDING(out = drive("car-park-anchored"));
  const MapError error = map_error(out.landmarks, out.beacons, 1);
  std::printf("landmarks %.3f m rms, vehicle %.3f m rms\n", error.rms_m, rms(out.path, out.gps));
  EXPECT_LT(error.rms_m, 0.12);             // 0.078
  EXPECT_LT(rms(out.path, out.gps), 0.13);  // 0.095
  EXPECT_EQ(error.matches.size(), 13u);
  EXPECT_TRUE(error.twice.empty() && error.unmatched.empty() && error.missing.empty());
  EXPECT_EQ(out.lost, 0);
}

TEST(CarPark, WithoutAnchorsTheMapAgreesAfterARigidTransformation) {
  Outcome out;
  SKIP_WITHOUT_RECORDING(out = drive("car-park"));
  const FittedMapError fitted = fitted_map_error(out.landmarks, out.beacons, 1, fit_rigid(out.path, out.gps));
  std::printf("relative map %.3f m rms, turned by %.1f degrees\n", fitted.error.rms_m,
              -fitted.fit.turn_rad * 57.29578);
  EXPECT_LT(fitted.error.rms_m, 0.10);  // 0.045
  EXPECT_EQ(fitted.error.matches.size(), 15u);
  EXPECT_TRUE(fitted.error.twice.empty() && fitted.error.unmatched.empty());
  EXPECT_GT(rms(out.path, out.gps), 1);  // before the fit
}

TEST(CarPark, AMapInTheVehicleFrameIsAsAccurate) {
  Outcome out;
  SKIP_WITHOUT_RECORDING(
      out = drive("car-park-anchored", {"estimator.map_frame=vehicle", "estimator.linearization=analytic"}));
  EXPECT_LT(map_error(out.landmarks, out.beacons, 1).rms_m, 0.12);
  EXPECT_LT(rms(out.path, out.gps), 0.16);
}

TEST(CarPark, WithAnchorsABlockDiagonalMapIsAccurate) {
  for (const char* decorrelate : {"map", "map-linear"}) {
    Outcome out;
    SKIP_WITHOUT_RECORDING(
        out = drive("car-park-anchored", {std::string("estimator.decorrelate=") + decorrelate,
                                          "estimator.linearization=analytic"}));
    EXPECT_LT(map_error(out.landmarks, out.beacons, 1).rms_m, 0.25) << decorrelate;
    EXPECT_LT(rms(out.path, out.gps), 0.20) << decorrelate;
  }
}

}  // namespace
}  // namespace incognita
