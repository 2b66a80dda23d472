// Compares Belief::update with its lower bound, Eigen's rank update of one triangle, and Belief::shear with the update.
//
// The variants alternate within one benchmark, so that load changes of the machine affect both, and medians
// are reported. `ratio` is the time of this library over Eigen's; both are built with the same flags.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "bench/timing.hpp"
#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/belief.hpp"
#include "incognita/belief/rank_update.hpp"
#include "incognita/math/random.hpp"

namespace {

using namespace incognita;

constexpr int camera_errors = 12, landmark_errors = 3, measurement_rows = 2, measurement_count = 12;
constexpr int rank = measurement_rows * measurement_count;

struct Normal {
  RandomStream stream{7, "bench"};
  double operator()(double) { return stream.normal(); }
};

Eigen::MatrixXd random_matrix(int rows, int columns) {
  static Normal normal;
  return Eigen::MatrixXd::Zero(rows, columns).unaryExpr([](double x) { return normal(x); });
}

/// A camera with a correlated map, its next motion and its next measurements.
struct Scene {
  Belief belief;
  LinearizedMotion motion;
  std::vector<LinearizedMeasurement> measurements;

  explicit Scene(int errors) : belief(errors) {
    const Chart chart{{Chart::Kind::line, 3}, {Chart::Kind::quaternion, 4}, {Chart::Kind::line, 6}};
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(13);
    mean[3] = 1;
    const BlockId camera =
        belief.add_vehicle(chart, mean, Eigen::MatrixXd::Identity(camera_errors, camera_errors));
    std::vector<BlockId> landmarks;
    while (belief.errors() + landmark_errors <= errors) {
      const Belief::Parent parent{camera, random_matrix(landmark_errors, camera_errors)};
      landmarks.push_back(belief.augment(Chart::line(landmark_errors), random_matrix(landmark_errors, 1),
                                         {&parent, 1}, Eigen::Matrix3d::Identity()));
    }
    motion = {camera, mean, BlockMatrix::Identity(camera_errors, camera_errors),
              1e-2 * BlockMatrix::Identity(camera_errors, camera_errors)};
    for (int i = 0; i < measurement_count; ++i) {  // spread over the whole map
      LinearizedMeasurement measurement;
      measurement.add(camera, random_matrix(measurement_rows, camera_errors));
      measurement.add(landmarks[(landmarks.size() - 1) * i / (measurement_count - 1)],
                      random_matrix(measurement_rows, landmark_errors));
      measurement.residual = MeasurementVector::Zero(measurement_rows);
      measurement.R = MeasurementMatrix::Identity(measurement_rows, measurement_rows);
      measurements.push_back(measurement);
    }
  }
};

/// Times of alternating runs, and the counters computed from them.
struct Turns {
  std::vector<double> ours, eigen, ratio;
  void add(double t_ours, double t_eigen) {
    ours.push_back(t_ours);
    eigen.push_back(t_eigen);
    ratio.push_back(t_ours / t_eigen);
  }
  void report(benchmark::State& state) const {
    state.counters["ours_ms"] = 1e3 * median(ours);
    state.counters["eigen_ms"] = 1e3 * median(eigen);
    state.counters["ratio"] = median(ratio);
  }
};

/// Operands of Eigen's rank update.
struct EigenUpdate {
  Eigen::MatrixXd P, W;
  explicit EigenUpdate(int n) : P(Eigen::MatrixXd::Identity(n, n)), W(1e-6 * random_matrix(n, rank)) {}
  void operator()() { P.selfadjointView<Eigen::Lower>().rankUpdate(W, -1.0); }
};

void update(benchmark::State& state) {
  Scene scene(static_cast<int>(state.range(0)));
  EigenUpdate eigen(scene.belief.errors());
  Turns turns;
  std::vector<double> predictions;
  scene.belief.update(scene.measurements);  // warm-up: allocates the workspace
  for (auto _ : state) {
    predictions.push_back(seconds([&] { scene.belief.predict(scene.motion); }));
    const double ours = seconds([&] {
      const UpdateReport report = scene.belief.update(scene.measurements);
      if (report.outcome != UpdateReport::Outcome::updated) state.SkipWithError("the update was refused");
    });
    turns.add(ours, seconds([&] { eigen(); }));
    state.SetIterationTime(ours);
  }
  turns.report(state);
  state.counters["predict_us"] = 1e6 * median(predictions);
}

/// Belief::shear of the whole map, as after a correction with invariant errors, compared with the update before it.
void shear(benchmark::State& state) {
  Scene scene(static_cast<int>(state.range(0)));
  constexpr int rotation = 3;
  std::vector<ErrorShear> shears;
  for (const LinearizedMeasurement& measurement : scene.measurements)
    shears.push_back({measurement.parts[1].block, 1e-6 * random_matrix(landmark_errors, rotation)});
  std::vector<double> times, ratios;
  scene.belief.update(scene.measurements);
  for (auto _ : state) {
    scene.belief.predict(scene.motion);
    const double before = seconds([&] { scene.belief.update(scene.measurements); });
    times.push_back(seconds([&] { scene.belief.shear(scene.motion.block, rotation, shears); }));
    ratios.push_back(times.back() / before);
    state.SetIterationTime(times.back());
  }
  state.counters["shear_ms"] = 1e3 * median(times);
  state.counters["ratio"] = median(ratios);
}

/// The rank update alone on each code path, compared with the memory bandwidth.
void bare(benchmark::State& state, const RankUpdatePath& path) {
  const int n = static_cast<int>(state.range(0)), stride = round_up_to_panel(n) + 8;
  AlignedBuffer P(static_cast<std::size_t>(stride) * n), W(static_cast<std::size_t>(stride) * rank);
  std::fill_n(W.data(), static_cast<long>(n) * rank, 1e-6);
  EigenUpdate eigen(n);
  Turns turns;
  std::vector<double> passes;
  for (auto _ : state) {
    const double ours = seconds([&] { path.run(P.data(), stride, n, W.data(), rank); });
    turns.add(ours, seconds([&] { eigen(); }));
    passes.push_back(seconds([&] {  // lower bound: read and write the triangle
      for (int j = 0; j < n; ++j) {
        double* column = P.data() + static_cast<long>(j) * stride;
        for (int i = j; i < n; ++i) column[i] -= 1e-9;
      }
      benchmark::ClobberMemory();
    }));
    state.SetIterationTime(ours);
  }
  turns.report(state);
  const double bytes = 2.0 * sizeof(double) * n * (n + 1) / 2;
  state.counters["GB/s"] = 1e-9 * bytes / median(turns.ours);
  state.counters["pass_GB/s"] = 1e-9 * bytes / median(passes);
}

BENCHMARK(update)->Arg(300)->Arg(600)->Arg(1200)->Arg(3000)->UseManualTime()->MinTime(0.7);

BENCHMARK(shear)->Arg(300)->Arg(600)->Arg(1200)->Arg(3000)->UseManualTime()->MinTime(0.3);

[[maybe_unused]] const bool registered = [] {
  for (const RankUpdatePath& path : rank_update_paths())
    benchmark::RegisterBenchmark((std::string("rank_update/") + path.name).c_str(), bare, path)
        ->Arg(300)
        ->Arg(600)
        ->Arg(1200)
        ->Arg(3000)
        ->UseManualTime()
        ->MinTime(0.3);
  return true;
}();

}  // namespace
