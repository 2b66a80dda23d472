// Cost of a camera SLAM frame as a function of map size with SceneLib's settings: ten measurements per frame,
// no decision. The camera stands before the target of the rendered room; further landmarks lie behind it,
// correlated with it and with each other, as after a long trajectory.
#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

using namespace incognita;

namespace {

constexpr double dt = 1.0 / 30;

struct Standing {
  Assembly assembly;
  Estimate estimate;
  std::vector<Observation> images;
  std::int64_t frame = 0;

  Tick next() { return {frame, static_cast<double>(frame) * dt, frame++ == 0 ? 0 : dt}; }
};

void add_unseen(Estimate& estimate, FeatureTracker& tracker, int count) {
  Feature appearance = tracker.camera().features.rbegin()->second;
  const CameraState x = estimate.camera_state();
  RandomStream random(1, "bench");
  Eigen::Matrix<double, 3, 12> with_camera = Eigen::Matrix<double, 3, 12>::Zero();
  with_camera.leftCols<3>().setIdentity();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d at =
        Eigen::Vector3d(x.head<3>()) +
        Eigen::Vector3d(-random.uniform(1, 4), random.uniform(-2, 2), random.uniform(-1, 1));
    Landmark landmark;
    landmark.id = new_id(estimate);
    landmark.camera = 0;
    landmark.first_view = x.head<3>();
    const Belief::Parent parent{estimate.body().block, with_camera};
    landmark.block =
        estimate.belief.augment(Chart::line(3), at, {&parent, 1}, 1e-4 * Eigen::Matrix3d::Identity());
    tracker.adopt(landmark.id, appearance);
    estimate.landmarks.emplace(landmark.id, landmark);
  }
}

/// A converged map with that many landmarks.
Standing standing(int landmarks) {
  const std::vector<std::string> sets{"plant.sigma_acceleration_m_s2=0",
                                      "plant.sigma_angular_acceleration_rad_s2=0",
                                      "search.max_measurements=10",
                                      "map.wanted_visible=22",
                                      "map.max_landmarks=22",
                                      "run.duration_s=1000"};
  Standing s{assemble(load_scenario("room", sets)), {}, {}};
  const LoopParts& parts = s.assembly.parts;
  for (int i = 0; i < 30; ++i) {
    const Tick tick = s.next();
    s.images.push_back(parts.sensor->measure(parts.world->move({}, tick), tick));
    parts.estimator->update(s.estimate, {}, s.images.back(), tick);
  }
  add_unseen(s.estimate, dynamic_cast<SlamEstimator&>(*parts.estimator).camera(0),
             landmarks - s.estimate.mapped_count());
  return s;
}

void frame(benchmark::State& state) {
  Standing s = standing(static_cast<int>(state.range(0)));
  std::map<std::string, double> stages;
  std::int64_t frames = 0, matched = 0;
  for (auto _ : state) {
    const Tick tick = s.next();
    s.assembly.parts.estimator->update(
        s.estimate, {}, s.images[static_cast<std::size_t>(tick.frame) % s.images.size()], tick);
    for (const auto& [stage, ms] : s.estimate.timing_ms) stages[stage] += ms;
    matched += s.estimate.last.matched;
    ++frames;
  }
  if (s.estimate.status.state != TrackingState::tracking) state.SkipWithError("does not track");
  for (const auto& [stage, ms] : stages)
    if (ms > 0) state.counters[stage + "_ms"] = ms / static_cast<double>(frames);
  state.counters["landmarks"] = s.estimate.mapped_count();
  state.counters["matched"] = static_cast<double>(matched) / static_cast<double>(frames);
  state.counters["states"] = static_cast<double>(s.estimate.belief.errors());
}
BENCHMARK(frame)->Arg(22)->Arg(111)->Arg(411)->Unit(benchmark::kMillisecond);

}  // namespace
