// The observability report of a run, for filters with known consistency.
#include "incognita/app/loop/observability_watch.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <memory>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/world/points/planar_loop.hpp"

namespace incognita {
namespace {

constexpr double start_sigma_rad = 0.3;

PlanarSlamSettings settings_for(const PlanarLoopSettings& drive) {
  PlanarSlamSettings s;
  s.vehicle.model = "differential-drive";
  s.vehicle.sigma_speed_m_s = drive.sigma_speed_m_s;
  s.vehicle.sigma_turn_rate_rad_s = drive.sigma_turn_rate_rad_s;
  s.sensor.sigma_range_m = drive.sigma_range_m;
  s.sensor.sigma_bearing_rad = drive.sigma_bearing_rad;
  s.filter.sigma_fix_m = drive.sigma_fix_m;
  s.start.sigma_heading_rad = start_sigma_rad;
  s.association.method = DataAssociationSettings::Method::known;
  s.association.gate_probability = 1 - 1e-12;
  s.health.max_sigma_position_m = 1e6;
  return s;
}

struct Watched {
  ObservabilityReport report;
  double filter_sigma_heading = 0;
};

/// A simulated circle, monitored.
Watched drive(double duration_s,
              const std::function<void(PlanarSlamSettings&, const RangeRecording&)>& change) {
  PlanarLoopSettings loop;
  loop.duration_s = duration_s;
  const RangeRecording recording = drive_planar_loop(loop, 5);
  PlanarSlamSettings settings = settings_for(loop);
  change(settings, recording);
  Assembly assembly = assemble_ranges(recording, settings, duration_s + 1);
  ObservabilityWatch watch;
  Watched out;
  run_loop(
      assembly.parts, [](const Snapshot&) {}, [](const Tick&) { return true; },
      [&](const Estimate& estimate) {
        watch.follow(estimate);
        out.filter_sigma_heading = std::sqrt(estimate.bodies.front().state_covariance(2, 2));
      });
  out.report = watch.report().value();
  return out;
}

Watched drive_with(double duration_s, Linearization linearization) {
  return drive(duration_s,
               [&](PlanarSlamSettings& s, const RangeRecording&) { s.filter.linearization = linearization; });
}

const QuantityReport& heading(const ObservabilityReport& report) { return report.quantities.back(); }

// Huang, Mourikis, Roumeliotis, IJRR 2010: the filter's own observability matrix has rank n - 2, not n - 3
TEST(ObservabilityWatch, EkfGainsSpuriousInformationOnTheHeading) {
  double before = start_sigma_rad;
  for (const double duration_s : {10, 63, 126}) {
    const Watched run = drive_with(duration_s, Linearization::analytic);
    const ObservabilityReport& report = run.report;
    EXPECT_EQ(report.ideal_nullity, 3);
    EXPECT_EQ(report.information.nullity(), 2);
    EXPECT_EQ(report.spurious_information, 1);
    EXPECT_FALSE(report.information.ambiguous);
    EXPECT_FALSE(report.quantities[0].estimated_sigma || report.quantities[1].estimated_sigma);
    ASSERT_TRUE(heading(report).gained);
    const double sigma = *heading(report).estimated_sigma;
    EXPECT_LT(sigma, before);
    before = sigma;
    // The filter's covariance combines the prior with the information since
    const double both = 1 / std::sqrt(std::pow(start_sigma_rad, -2) + std::pow(sigma, -2));
    std::printf("%3.0f s: sigma of the information %.4f rad, with the prior %.4f, of the filter %.4f\n",
                duration_s, sigma, both, run.filter_sigma_heading);
    EXPECT_NEAR(run.filter_sigma_heading, both, 0.05 * both);
  }
}

TEST(ObservabilityWatch, FirstEstimateJacobiansGainNone) {
  const Watched run = drive_with(250, Linearization::first_estimate);
  EXPECT_EQ(run.report.information.nullity(), 3);
  EXPECT_EQ(run.report.spurious_information, 0);
  EXPECT_FALSE(heading(run.report).estimated_sigma);
  EXPECT_GE(run.filter_sigma_heading, start_sigma_rad * (1 - 1e-9));
}

TEST(ObservabilityWatch, AnchorsAndPositionFixesFixTheFrame) {
  const Watched anchored = drive(60, [](PlanarSlamSettings& s, const RangeRecording& r) {
    s.filter.anchors = {r.landmarks[0].position, r.landmarks[1].position};
  });
  EXPECT_EQ(anchored.report.anchors, 2);
  EXPECT_EQ(anchored.report.ideal_nullity, 0);
  EXPECT_EQ(anchored.report.information.nullity(), 0);
  EXPECT_TRUE(heading(anchored.report).gained);
  const Watched fixed =
      drive(60, [](PlanarSlamSettings& s, const RangeRecording&) { s.filter.use_fixes = true; });
  EXPECT_TRUE(fixed.report.position_fixes);
  EXPECT_EQ(fixed.report.ideal_nullity, 0);
  EXPECT_EQ(in_words(fixed.report)[1], "heading: fixed by position fixes");
  EXPECT_NEAR(*heading(fixed.report).estimated_sigma, fixed.filter_sigma_heading,
              0.05 * fixed.filter_sigma_heading);
}

TEST(ObservabilityWatch, OneAnchorLeavesTheHeadingUnobservable) {
  const Watched run = drive(60, [](PlanarSlamSettings& s, const RangeRecording& r) {
    s.filter.anchors = {r.landmarks[0].position};
    s.filter.linearization = Linearization::first_estimate;
  });
  EXPECT_EQ(run.report.ideal_nullity, 1);
  EXPECT_EQ(run.report.information.nullity(), 1);
  EXPECT_EQ(in_words(run.report)[1], "heading: unobservable with 1 anchor");
}

TEST(ObservabilityWatch, ReportsUncoveredFilters) {
  const Watched from_vehicle =
      drive(20, [](PlanarSlamSettings& s, const RangeRecording&) { s.filter.map_frame = MapFrame::vehicle; });
  EXPECT_EQ(from_vehicle.report.uncovered, "the map is expressed in the vehicle frame, or a loop was closed");
  EXPECT_FALSE(heading(from_vehicle.report).estimated_sigma);
  EXPECT_EQ(in_words(from_vehicle.report).size(), 3u);
  const Watched anchored = drive(20, [](PlanarSlamSettings& s, const RangeRecording& r) {
    s.filter.map_frame = MapFrame::vehicle;
    s.filter.anchors = {r.landmarks[0].position, r.landmarks[1].position};
  });
  EXPECT_EQ(in_words(anchored.report)[0], "position: observable with 2 anchors");
  for (const auto how : {Decorrelation::everything, Decorrelation::map, Decorrelation::map_linear}) {
    const Watched dropped =
        drive(5, [&](PlanarSlamSettings& s, const RangeRecording&) { s.filter.decorrelate = how; });
    EXPECT_EQ(dropped.report.uncovered, "the filter decorrelates its map") << static_cast<int>(how);
  }
}

TEST(ObservabilityWatch, ReportsNonFiniteNumbersAndTheIdealNullity) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Estimate estimate;
  estimate.bodies.resize(1);
  estimate.bodies[0].block =
      estimate.belief.add_vehicle(planar::pose_chart, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());
  estimate.started = true;
  for (const bool of_mean : {true, false}) {
    Estimate broken = estimate;
    ObservabilityWatch watch;
    broken.belief.keep_trace(true);
    watch.follow(broken);
    EXPECT_EQ(watch.report()->uncovered, "");
    const Eigen::Vector3d next = of_mean ? Eigen::Vector3d(nan, 0, 0) : Eigen::Vector3d(1, 2, 3);
    Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
    if (!of_mean) A(0, 0) = nan;
    broken.belief.predict({broken.bodies[0].block, next, A, Eigen::Matrix3d::Identity()});
    watch.follow(broken);
    const auto report = watch.report();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->uncovered,
              of_mean ? "the estimate is not finite" : "the filter's information is not finite");
    EXPECT_EQ(report->ideal_nullity, 3);
    ASSERT_EQ(report->quantities.size(), 3u);
    EXPECT_FALSE(report->quantities[0].ideally_observable || report->quantities[0].estimated_sigma);
  }
}

// Camera
// ---------------------------------------------------------------------------------------------------------

/// A camera that moves fast by commands among points, some of them anchors; Jacobians at the true states.
struct CommandedCamera {
  explicit CommandedCamera(int anchors) {
    CameraState x = CameraState::Zero();
    x[3] = 1;
    camera = estimate.bodies.emplace_back().block = estimate.belief.add_vehicle(
        FreeCameraMotion::chart, x, 1e-4 * FreeCameraMotion::Jacobian::Identity());
    estimate.started = true;
    estimate.belief.keep_trace(true);
    for (int i = 0; i < 9; ++i) {
      Landmark& landmark = estimate.landmarks[i];
      landmark.id = i;
      const Eigen::Vector3d at(0.5 * (i % 3) - 0.5, 0.4 * (i / 3) - 0.4, 2 + 0.3 * (i % 4));
      landmark.fixed = i < anchors;
      landmark.position = at;
      const Belief::Parent parent{camera, Eigen::MatrixXd::Zero(3, 12)};  // as if independent
      if (i >= anchors)
        landmark.block =
            estimate.belief.augment(PointLandmark::chart, at, {&parent, 1}, Eigen::Matrix3d::Identity());
    }
    for (int frame = 0; frame < 100; ++frame) step(frame / 30.0);
  }
  void step(double t) {
    Eigen::Matrix<double, 6, 1> u = Eigen::Matrix<double, 6, 1>::Zero();
    u.head<3>() << std::cos(2 * t), 0.7 * std::sin(2 * t), 0.5 * std::cos(2 * t);
    const auto moved = FreeCameraMotion{}.step(estimate.camera_state(), u, 1.0 / 30);
    estimate.belief.predict({camera, moved.x, moved.F, 1e-4 * moved.G * moved.G.transpose()});
    std::vector<LinearizedMeasurement> measurements;
    estimate.last.restart();
    for (const auto& [id, landmark] : estimate.landmarks) {
      const auto prediction =
          PointLandmark::predict_measurement(Camera{WideAngleCamera{}}, moved.x, landmark.position);
      LinearizedMeasurement& measurement = measurements.emplace_back();
      measurement.add(camera, prediction->Hv);
      if (!landmark.fixed) measurement.add(landmark.block, prediction->Hl);
      measurement.residual = Eigen::Vector2d::Zero();
      measurement.R = 0.16 * Eigen::Matrix2d::Identity();
      Match& match = estimate.last.matches.emplace_back();
      match.id = id;
      match.anchor = landmark.fixed;
      match.outcome = MatchOutcome::matched;
    }
    estimate.last.update = estimate.belief.update(measurements);
    watch.follow(estimate);
    estimate.belief.clear_trace();
  }
  Estimate estimate;
  BlockId camera = 0;
  ObservabilityWatch watch;
};

TEST(ObservabilityWatch, InformationFromCommandsIsNotSpurious) {
  const ObservabilityReport free = CommandedCamera(0).watch.report().value();
  EXPECT_EQ(free.ideal_nullity, 7);
  EXPECT_EQ(free.spurious_information, 0);
  EXPECT_EQ(free.by_motion_model, 4);
  const ObservabilityReport one = CommandedCamera(1).watch.report().value();
  EXPECT_EQ(one.ideal_nullity, 4);
  EXPECT_EQ(one.spurious_information, 0);
  EXPECT_EQ(one.by_motion_model, 4);
  const ObservabilityReport fixed = CommandedCamera(4).watch.report().value();
  EXPECT_EQ(fixed.ideal_nullity, 0);
  EXPECT_EQ(fixed.spurious_information + fixed.by_motion_model, 0);
  EXPECT_EQ(in_words(fixed)[2], "scale: fixed by 4 anchors");
}

TEST(ObservabilityWatch, WithoutAMonitorNothingIsTraced) {
  PlanarLoopSettings loop;
  loop.duration_s = 5;
  Assembly assembly = assemble_ranges(drive_planar_loop(loop, 5), settings_for(loop), 10);
  auto& [clock, world, sensor, estimator, decision, controller, map_truth] = assembly.parts;
  Estimate unwatched, watched;
  watched.belief.keep_trace(true);
  while (const Tick tick = clock->next()) {
    const Observation observation = sensor->measure({}, tick);
    for (Estimate* estimate : {&unwatched, &watched}) estimator->update(*estimate, {}, observation, tick);
    EXPECT_TRUE(unwatched.belief.trace().empty());
    EXPECT_FALSE(watched.belief.trace().empty());
    watched.belief.clear_trace();
  }
  EXPECT_EQ(watched.belief.dense_covariance(), unwatched.belief.dense_covariance());
}

}  // namespace
}  // namespace incognita
