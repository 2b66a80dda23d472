// Cost of the decision as a function of map size: evaluated actions per second, compared in the same run with
// the method of the thesis (determinants of the whole covariance before and after), and complete frames of
// camera SLAM in which every action is scored.
#include <benchmark/benchmark.h>

#include <Eigen/LU>
#include <algorithm>
#include <string>
#include <vector>

#include "bench/timing.hpp"
#include "incognita/app/loop/assembly.hpp"
#include "incognita/app/loop/snapshot_of.hpp"
#include "incognita/decision/decision.hpp"
#include "incognita/decision/exploration.hpp"
#include "incognita/decision/image_expectation.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

using namespace incognita;

namespace {

constexpr double dt = 1.0 / 30;

CameraSlamSettings twelve_measurements() {
  CameraSlamSettings slam;
  slam.search.max_measurements = 12;  // 24 rows
  slam.map.max_view_angle_rad = 3;
  slam.map.max_scale = 10;
  return slam;
}

/// A camera amid landmarks in all directions, all correlated, one in ten of them accurate.
Estimate among(int landmarks) {
  Estimate e;
  CameraState x = CameraState::Zero();
  x.segment<4>(3) = level_gaze(0);
  e.bodies.emplace_back().block =
      e.belief.add_vehicle(FreeCameraMotion::chart, x, 1e-4 * FreeCameraMotion::Jacobian::Identity());
  e.started = true;
  e.status.state = TrackingState::tracking;
  RandomStream random(1, "bench");
  Eigen::Matrix<double, 3, 12> with_camera = Eigen::Matrix<double, 3, 12>::Zero();
  with_camera.leftCols<3>().setIdentity();
  for (int i = 0; i < landmarks; ++i) {
    Landmark landmark{};
    landmark.camera = 0;
    landmark.id = new_id(e);
    const Eigen::Vector3d way(random.normal(), random.normal(), 0.4 * random.normal());
    const Eigen::Vector3d at = way.normalized() * random.uniform(1, 4);
    const Belief::Parent parent{e.body().block, with_camera};
    const double sigma = i % 10 == 0 ? 0.01 : 0.1;
    landmark.block =
        e.belief.augment(PointLandmark::chart, at, {&parent, 1}, sigma * sigma * Eigen::Matrix3d::Identity());
    e.landmarks.emplace(landmark.id, landmark);
  }
  return e;
}

/// (log|P| - log|P after|) / 2 of the whole state: predict, update and two factorizations, as in thesis 6.3.2.
double by_determinants(const Eigen::MatrixXd& P, const ImaginedStep& step, const AnyBelief& belief) {
  Eigen::MatrixXd moved = P;
  moved.topRows(12) = step.A * moved.topRows(12);
  moved.leftCols(12) = moved.leftCols(12) * step.A.transpose();
  moved.topLeftCorner(12, 12) += step.N;
  Eigen::MatrixXd H =
      Eigen::MatrixXd::Zero(2 * static_cast<Eigen::Index>(step.measurements.size()), P.cols());
  for (std::size_t i = 0; i < step.measurements.size(); ++i) {
    const auto row = 2 * static_cast<Eigen::Index>(i);
    H.block(row, 0, 2, 12) = step.measurements[i].Hv;
    if (step.measurements[i].Hl.cols() > 0)
      H.block(row, belief.offset(step.measurements[i].block), 2, 3) = step.measurements[i].Hl;
  }
  const Eigen::MatrixXd HP = H * moved;
  const Eigen::MatrixXd S =
      HP * H.transpose() +
      Eigen::MatrixXd(step.measurements[0].R(0, 0) * Eigen::MatrixXd::Identity(H.rows(), H.rows()));
  const Eigen::MatrixXd after = moved - HP.transpose() * S.ldlt().solve(HP);
  return 0.5 * (moved.partialPivLu().matrixLU().diagonal().array().abs().log().sum() -
                after.partialPivLu().matrixLU().diagonal().array().abs().log().sum());
}

MapExpectation by_one_camera() {
  std::vector<MapExpectation::OfBody> bodies(1);
  bodies[0].push_back(std::make_unique<ImageExpectation>(WideAngleCamera{}, twelve_measurements()));
  return MapExpectation(std::move(bodies));
}

/// Predicts and scores action after action, with that many mapped landmarks and expected unmapped ones, which
/// the method of the thesis does not consider.
void evaluation(benchmark::State& state) {
  const Estimate e = among(static_cast<int>(state.range(0)));
  MapExpectation expectation = by_one_camera();
  const Exploration unseen({.expected_landmarks = static_cast<int>(state.range(1))}, 1);
  expectation.prepare(e, 0, unseen.expected(), 1.5);
  const Translations moves(seven_translations(0.3), 1, growth_over(1, 0.3, 0.3), {});
  InformationGain gain;
  ImaginedStep step;
  const CameraState now = e.camera_state();
  std::int64_t evaluations = 0;
  std::size_t measurements = 0;
  const auto evaluate = [&] {
    const ActionOutcome out = moves.after(now, static_cast<int>(evaluations++ % 7));
    step.A = out.A;
    step.N = out.N;
    expectation.expect(out.state, step.measurements);
    gain.push(step);
    benchmark::DoNotOptimize(gain.of_state());
    gain.pop();
    measurements = step.measurements.size();
  };
  gain.start(e.belief, e.body().block);
  for (auto _ : state) evaluate();
  state.counters["looks"] = static_cast<double>(measurements);
  state.counters["states"] = static_cast<double>(e.belief.errors());
  if (state.range(1) > 0) {
    state.counters["a_second"] = 70 / seconds([&] {
                                   for (int i = 0; i < 70; ++i) evaluate();
                                 });
    return;
  }
  const Eigen::MatrixXd P = e.belief.dense_covariance();
  std::vector<double> ours, theirs;
  double difference = 0;
  for (int turn = 0; turn < 3; ++turn) {
    ours.push_back(seconds([&] {
                     for (int i = 0; i < 70; ++i) evaluate();
                   }) /
                   70);
    double textbook = 0;
    theirs.push_back(seconds([&] { textbook = by_determinants(P, step, e.belief); }));
    gain.push(step);
    difference = std::max(difference, std::abs(gain.of_state() - textbook));
    gain.pop();
  }
  state.counters["a_second"] = 1 / median(ours);
  state.counters["thesis_way_a_second"] = 1 / median(theirs);
  state.counters["times_faster"] = median(theirs) / median(ours);
  state.counters["nats_apart"] = difference;
}
BENCHMARK(evaluation)
    ->Args({30, 0})
    ->Args({100, 0})
    ->Args({300, 0})
    ->Args({1000, 0})
    ->Args({100, 50})
    ->Unit(benchmark::kMicrosecond);

/// Sequences of that many actions, scored by look-ahead.
void look_ahead(benchmark::State& state) {
  const Estimate e = among(100);
  MapExpectation expectation = by_one_camera();
  const std::vector<ExpectedLandmark> nothing;
  expectation.prepare(e, 0, nothing, 1.5);
  const Translations moves(seven_translations(0.3), 1, growth_over(1, 0.3, 0.3), {});
  LookAhead ahead({Metric::state, static_cast<int>(state.range(0)), 210, 3});
  for (auto _ : state)
    benchmark::DoNotOptimize(ahead.scores(e.belief, e.body().block, e.camera_state(), moves, expectation));
  state.counters["evaluations"] = ahead.evaluations();
}
BENCHMARK(look_ahead)->Arg(1)->Arg(2)->Arg(3)->Arg(4)->Unit(benchmark::kMillisecond);

/// Everything the loop computes in a frame except rendering and file output: camera SLAM, scores of all
/// actions (seven translations in every frame and three rotations every 50 ms), command and snapshot. The
/// estimator runs in the rendered room, its map extended by landmarks behind the camera; the decision uses a
/// map of the same size all around the camera, with some two hundred landmarks in view.
void frame(benchmark::State& state) {
  const auto landmarks = static_cast<int>(state.range(0));
  const std::vector<std::string> sets{"plant.sigma_acceleration_m_s2=0",
                                      "plant.sigma_angular_acceleration_rad_s2=0",
                                      "search.max_measurements=12",
                                      "map.wanted_visible=22",
                                      "map.max_landmarks=22",
                                      "run.duration_s=1000"};
  Assembly room = assemble(load_scenario("room", sets));
  Estimate estimate = {}, around = among(landmarks);
  std::vector<Observation> images;
  std::int64_t count = 0;
  const auto next = [&] { return Tick{count, static_cast<double>(count) * dt, count++ == 0 ? 0 : dt}; };
  for (int i = 0; i < 30; ++i) {
    const Tick tick = next();
    images.push_back(room.parts.sensor->measure(room.parts.world->move({}, tick), tick));
    room.parts.estimator->update(estimate, {}, images.back(), tick);
  }
  Eigen::Matrix<double, 3, 12> with_camera = Eigen::Matrix<double, 3, 12>::Zero();
  with_camera.leftCols<3>().setIdentity();
  RandomStream random(2, "bench");
  FeatureTracker& tracker = dynamic_cast<SlamEstimator&>(*room.parts.estimator).camera(0);
  const Feature appearance = tracker.camera().features.rbegin()->second;
  while (estimate.mapped_count() < landmarks) {
    const Eigen::Vector3d at =
        Eigen::Vector3d(estimate.camera_state().head<3>()) +
        Eigen::Vector3d(-random.uniform(1, 4), random.uniform(-2, 2), random.uniform(-1, 1));
    Landmark landmark;
    landmark.id = new_id(estimate);
    landmark.camera = 0;
    tracker.adopt(landmark.id, appearance);
    const Belief::Parent parent{estimate.body().block, with_camera};
    landmark.block =
        estimate.belief.augment(Chart::line(3), at, {&parent, 1}, 1e-4 * Eigen::Matrix3d::Identity());
    estimate.landmarks.emplace(landmark.id, landmark);
  }
  ActiveSettings settings;
  settings.decision.gaze = DecisionSettings::Gaze::mutual_information;
  settings.exploration.expected_landmarks = landmarks + 30;
  const auto decision =
      decide_for(single_camera(WideAngleCamera{}, {}, twelve_measurements(), 10, 1), settings);
  std::vector<double> all, deciding, reporting_ms;
  for (auto _ : state) {
    const Tick tick = next();
    const Observation& observation = images[static_cast<std::size_t>(tick.frame) % images.size()];
    const double update = seconds([&] { room.parts.estimator->update(estimate, {}, observation, tick); });
    Goal goal;
    deciding.push_back(1e3 * seconds([&] { goal = decision->choose(around, tick); }));
    reporting_ms.push_back(1e3 * seconds([&] {
                             const Command command =
                                 room.parts.controller->act(estimate, goal, observation, tick);
                             benchmark::DoNotOptimize(snapshot_of(tick, std::nullopt, observation, estimate,
                                                                  goal, *decision, command, {}));
                           }));
    all.push_back(1e3 * update + deciding.back() + reporting_ms.back());
    state.SetIterationTime(1e-3 * all.back());
  }
  if (estimate.status.state != TrackingState::tracking) state.SkipWithError("does not track");
  std::sort(all.begin(), all.end());
  state.counters["median_ms"] = median(all);
  state.counters["p99_ms"] = all[all.size() * 99 / 100];
  state.counters["deciding_ms"] = median(deciding);
  state.counters["reporting_ms"] = median(reporting_ms);
  state.counters["states"] = static_cast<double>(estimate.belief.errors());
}
BENCHMARK(frame)->Arg(100)->Arg(300)->Arg(1000)->Iterations(300)->UseManualTime()->Unit(
    benchmark::kMillisecond);

}  // namespace
