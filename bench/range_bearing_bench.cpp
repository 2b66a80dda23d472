// Cost of a planar range-bearing EKF-SLAM step with known data association as a function of map size.
//
// A step is a prediction and an update with the ten nearest landmarks, including linearization. It alternates
// with `bare`, Eigen's rank update of one triangle of the same size and rank, compiled with the same flags,
// and `kernel`, the library's own, so that load changes affect all alike. `ratio` is a step over `bare`.
// `growth` alternates all sizes and reports the exponents of N from 100 to 800 landmarks; `dropped` does so
// for a block-diagonal map covariance.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "bench/timing.hpp"
#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/belief.hpp"
#include "incognita/belief/rank_update.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/models/sensors/range_bearing.hpp"

namespace {

using namespace incognita;

constexpr int seen_count = 10, rank = 2 * seen_count;
constexpr double step_m = 2, beside_m = 3;
constexpr double sigma_range_m = 0.05, sigma_bearing_rad = 0.003;
constexpr double sigma_speed_m_s = 0.05, sigma_turn_rad_s = 0.005;

/// A vehicle on a regular polygon, one side per second; each corner has a landmark, alternately on the left
/// and on the right. After the first lap all landmarks are mapped and all laps are equivalent.
class World {
 public:
  explicit World(int landmarks) : u_(step_m, 2 * std::numbers::pi / landmarks) {
    planar::Pose<double> x = planar::Pose<double>::Zero();
    for (int i = 0; i < landmarks; ++i, x = vehicle.f<double>(x, u_, 1)) {
      const double side = i % 2 == 0 ? beside_m : -beside_m;
      corners_.push_back(x);
      points_.emplace_back(x[0] - side * std::sin(x[2]), x[1] + side * std::cos(x[2]));
    }
  }

  static constexpr DifferentialDrive vehicle{};
  int landmarks() const { return static_cast<int>(points_.size()); }
  const planar::Pose<double>& pose(long step) const { return corners_[index(step)]; }
  /// The i-th landmark in view: that of the current corner, the four before or the five ahead.
  int seen(long step, int i) const { return static_cast<int>(index(step + landmarks() + i - 4)); }

  Eigen::Vector2d input() {
    return u_ + Eigen::Vector2d(sigma_speed_m_s * random_.normal(), sigma_turn_rad_s * random_.normal());
  }
  Eigen::Vector2d measured(long step, int landmark) {
    return RangeBearing::h<double>(pose(step), points_[static_cast<std::size_t>(landmark)]) +
           Eigen::Vector2d(sigma_range_m * random_.normal(), sigma_bearing_rad * random_.normal());
  }

 private:
  std::size_t index(long step) const { return static_cast<std::size_t>(step) % points_.size(); }
  Eigen::Vector2d u_;
  std::vector<planar::Pose<double>> corners_;
  std::vector<Eigen::Vector2d> points_;
  RandomStream random_{3, "range and bearing"};
};

/// The filter with the inputs of one step.
class Slam {
 public:
  explicit Slam(int landmarks, MapCorrelations correlations = MapCorrelations::full)
      : world_(landmarks),
        belief_(3 + 2 * landmarks, correlations),
        vehicle_(belief_.add_vehicle(planar::pose_chart, world_.pose(0), 1e-6 * Eigen::Matrix3d::Identity())),
        ids_(static_cast<std::size_t>(landmarks), unmapped),
        seen_(seen_count) {
    initialization();
    for (int i = 0; i < landmarks; ++i) {  // the first lap
      listen();
      step();
      initialization();
    }
  }

  int errors() const { return belief_.errors(); }
  double error_m() const {
    return (Eigen::Vector2d(belief_.mean(vehicle_).head<2>()) - world_.pose(step_).head<2>()).norm();
  }

  /// Generates the next odometry and measurements; not part of the step's cost.
  void listen() {
    ++step_;
    u_ = world_.input();
    for (int i = 0; i < seen_count; ++i) {
      const int landmark = world_.seen(step_, i);
      seen_[static_cast<std::size_t>(i)] = {ids_[static_cast<std::size_t>(landmark)],
                                            world_.measured(step_, landmark)};
    }
  }

  UpdateReport step() {
    predict();
    measurements_.clear();
    const planar::Pose<double> x = belief_.mean(vehicle_);
    for (const Seen& seen : seen_)
      if (seen.id != unmapped) measure(x, seen);
    return belief_.update(measurements_);
  }

 private:
  static constexpr BlockId unmapped = static_cast<BlockId>(-1);
  struct Seen {
    BlockId id = unmapped;
    Eigen::Vector2d z{0, 0};
  };

  void predict() {
    const auto next = World::vehicle.step(belief_.mean(vehicle_), u_, 1);
    const Eigen::Vector2d variances(sigma_speed_m_s * sigma_speed_m_s, sigma_turn_rad_s * sigma_turn_rad_s);
    belief_.predict({vehicle_, next.x, next.F, next.G * variances.asDiagonal() * next.G.transpose()});
  }

  void measure(const planar::Pose<double>& x, const Seen& seen) {
    const auto expected = RangeBearing::predict_measurement(x, belief_.mean(seen.id));
    if (!expected) return;
    LinearizedMeasurement& measurement = measurements_.emplace_back();
    measurement.add(vehicle_, expected->Hv);
    measurement.add(seen.id, expected->Hl);
    measurement.residual.resize(2);
    RangeBearing::chart.minus({seen.z.data(), 2}, {expected->z.data(), 2}, {measurement.residual.data(), 2});
    measurement.R = noise();
  }

  void initialization() {
    for (int i = 0; i < seen_count; ++i) {
      const int landmark = world_.seen(step_, i);
      BlockId& id = ids_[static_cast<std::size_t>(landmark)];
      if (id != unmapped) continue;
      const auto initialized =
          RangeBearing::initialize(belief_.mean(vehicle_), world_.measured(step_, landmark));
      const Belief::Parent parent{vehicle_, initialized.Jv};
      id = belief_.augment(RangeBearing::landmark_chart, initialized.landmark, {&parent, 1},
                           initialized.Jz * noise() * initialized.Jz.transpose());
    }
  }

  static Eigen::Matrix2d noise() {
    return Eigen::Vector2d(sigma_range_m * sigma_range_m, sigma_bearing_rad * sigma_bearing_rad).asDiagonal();
  }

  World world_;
  Belief belief_;
  BlockId vehicle_;
  std::vector<BlockId> ids_;
  std::vector<Seen> seen_;
  std::vector<LinearizedMeasurement> measurements_;
  Eigen::Vector2d u_{0, 0};
  long step_ = 0;
};

/// A mapped world with that many landmarks, and rank updates of the size of its steps.
struct Contest {
  Slam slam;
  Eigen::MatrixXd P, W;
  int stride;
  AlignedBuffer storage, packed;
  std::vector<double> steps, bares, kernels, ratios, over_kernels;

  explicit Contest(int landmarks)
      : slam(landmarks),
        P(Eigen::MatrixXd::Identity(slam.errors(), slam.errors())),
        W(Eigen::MatrixXd::Constant(slam.errors(), rank, 1e-9)),
        stride(round_up_to_panel(slam.errors()) + 8),
        storage(static_cast<std::size_t>(stride) * (slam.errors() + 8)),
        packed(static_cast<std::size_t>(stride) * rank) {
    std::fill_n(packed.data(), static_cast<long>(slam.errors()) * rank, 1e-9);
  }

  /// False if the update was refused.
  bool turn() {
    slam.listen();
    UpdateReport report;
    const double step = seconds([&] { report = slam.step(); });
    const double bare = seconds([&] { P.selfadjointView<Eigen::Lower>().rankUpdate(W, -1.0); });
    const double kernel =
        seconds([&] { rank_update(storage.data(), stride, slam.errors(), packed.data(), rank); });
    steps.push_back(step);
    bares.push_back(bare);
    kernels.push_back(kernel);
    ratios.push_back(step / bare);
    over_kernels.push_back(step / kernel);
    return report.outcome == UpdateReport::Outcome::updated && report.rows == rank;
  }

  void forget() {
    for (auto* times : {&steps, &bares, &kernels, &ratios, &over_kernels}) times->clear();
  }
};

/// Kept between benchmarks, because steps are comparable only after the first lap.
Contest& contest(int landmarks) {
  static std::map<int, Contest> all;
  return all.try_emplace(landmarks, landmarks).first->second;
}

void step(benchmark::State& state) {
  Contest& c = contest(static_cast<int>(state.range(0)));
  c.forget();
  for (auto _ : state) {
    if (!c.turn()) state.SkipWithError("the update was refused");
    state.SetIterationTime(c.steps.back());
  }
  const auto report = [&](const std::string& name, const std::vector<double>& times) {
    state.counters[name + "_ms"] = 1e3 * median(times);
    state.counters[name + "_least"] = 1e3 * *std::min_element(times.begin(), times.end());
  };
  report("step", c.steps);
  report("bare", c.bares);
  report("kernel", c.kernels);
  state.counters["ratio"] = median(c.ratios);
  state.counters["over_kernel"] = median(c.over_kernels);
  // Checks that the filter still works. A lap of 800 landmarks is 1.6 km, where linearization errors reach meters.
  state.counters["error_m"] = c.slam.error_m();
}

/// Slope of the regression line through (log x, log y).
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const Eigen::ArrayXd a = Eigen::Map<const Eigen::ArrayXd>(x.data(), x.size()).log();
  const Eigen::ArrayXd b = Eigen::Map<const Eigen::ArrayXd>(y.data(), y.size()).log();
  return ((a - a.mean()) * (b - b.mean())).sum() / (a - a.mean()).square().sum();
}

void growth(benchmark::State& state) {
  constexpr int steps_in_turn = 10;  // keeps the caches warm as in a run
  const std::vector<double> sizes{100, 200, 400, 800};
  for (const double n : sizes) contest(static_cast<int>(n)).forget();
  for (auto _ : state)
    for (const double n : sizes)
      for (int i = 0; i < steps_in_turn; ++i) contest(static_cast<int>(n)).turn();
  std::vector<double> steps, bares, kernels;
  for (const double n : sizes) {
    const Contest& c = contest(static_cast<int>(n));
    steps.push_back(median(c.steps));
    bares.push_back(median(c.bares));
    kernels.push_back(median(c.kernels));
  }
  state.counters["exponent"] = exponent(sizes, steps);
  state.counters["bare_exponent"] = exponent(sizes, bares);
  state.counters["kernel_exponent"] = exponent(sizes, kernels);
}

/// The same steps with a block-diagonal map covariance: the cost is linear in the map size.
void dropped(benchmark::State& state) {
  const std::vector<double> sizes{100, 200, 400, 800, 1600};
  static std::map<int, Slam> all;
  for (const double n : sizes)
    all.try_emplace(static_cast<int>(n), static_cast<int>(n), MapCorrelations::block_diagonal);
  std::map<int, std::vector<double>> times;
  for (auto _ : state)
    for (auto& [n, slam] : all)
      for (int i = 0; i < 10; ++i) {
        slam.listen();
        times[n].push_back(seconds([&] { slam.step(); }));
      }
  std::vector<double> medians;
  for (const double n : sizes) {
    medians.push_back(median(times[static_cast<int>(n)]));
    state.counters["ms_" + std::to_string(static_cast<int>(n))] = 1e3 * medians.back();
  }
  state.counters["exponent"] = exponent(sizes, medians);
}

BENCHMARK(step)->Arg(50)->Arg(100)->Arg(200)->Arg(400)->Arg(800)->UseManualTime()->MinTime(0.7);
BENCHMARK(growth)->Unit(benchmark::kMillisecond)->MinTime(5);
BENCHMARK(dropped)->Unit(benchmark::kMillisecond)->MinTime(2);

}  // namespace
