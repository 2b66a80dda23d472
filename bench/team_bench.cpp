// Cost of a tick of a robot team in one belief, as a function of the number of measurements, the map size and
// the team size.
//
// Robots move in groups of four on circles so small that each always sees the other three, and the point
// landmarks within its scanner's range. All landmarks are mapped. A tick is that of the estimator: predict
// all robots, linearize and gate all detections, one joint update. It alternates with Eigen's rank update of
// one triangle of the same size and rank, compiled with the same flags, so that load changes affect both
// alike: `ratio` is a tick over that. Stages are in ms of wall-clock time.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/timing.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/slam/mapper/measurements.hpp"
#include "incognita/world/fixed_rate_clock.hpp"
#include "incognita/world/points/point_world.hpp"

namespace {

using namespace incognita;

constexpr double rate_hz = 10;
constexpr double landmarks_per_m2 = 0.05, apart_m = 1.5, radius_m = 1.5, speed_m_s = 0.5;
constexpr int group = 4;

double side_of(int landmarks) { return std::sqrt(landmarks / landmarks_per_m2); }

PointLandmarks drawn_landmarks(int landmarks) {
  PointLandmarks place;
  RandomStream random(7, "place");
  const double half = side_of(landmarks) / 2;
  for (int i = 0; i < landmarks; ++i)
    place[i] = Eigen::Vector2d(random.uniform(-half, half), random.uniform(-half, half));
  return place;
}

/// Groups form a grid over the landmarks; the four robots of each are placed around its center.
std::vector<SimulatedVehicle> drawn_team(int robots, int landmarks) {
  const int groups = (robots + group - 1) / group,
            across = static_cast<int>(std::ceil(std::sqrt(double(groups))));
  const double pitch = side_of(landmarks) / across;
  std::vector<SimulatedVehicle> team;
  for (int i = 0; i < robots; ++i) {
    const int g = i / group;
    const Eigen::Vector2d center(pitch * (g % across - 0.5 * (across - 1)),
                                 pitch * (g / across - 0.5 * (across - 1))),
        beside(apart_m * (i % 2 ? 1 : -1), apart_m * (i / 2 % 2 ? 1 : -1));
    const SmallVector start = Eigen::Vector3d(center.x() + beside.x(), center.y() + beside.y(), 0);
    SimulatedVehicle v{{DifferentialDrive{}, {}, {}}, {RangeBearingSensor{}, Eigen::Vector2d(0.1, 0.02)}};
    v.body.plant = {start, Eigen::Vector3d::Constant(0.01), Eigen::Vector2d::Constant(0.05),
                    Eigen::Vector2d::Constant(-2), Eigen::Vector2d::Constant(2)};
    team.push_back(v);
  }
  return team;
}

EstimatorSettings filter_of(const std::vector<SimulatedVehicle>& team) {
  EstimatorSettings settings;
  for (const SimulatedVehicle& v : team)
    settings.bodies.push_back(body_with_sensor(v.body.motion, v.sensor.model, v.body.plant.start,
                                               v.body.plant.start_sigmas, v.body.plant.input_sigmas,
                                               v.sensor.sigmas));
  settings.filter.gate_probability = 0.9999;
  settings.health.max_sigma_position_m = 1e3;
  return settings;
}

/// A team with a complete map: at the first tick, the first robot sees all landmarks.
class Team {
 public:
  Team(int robots, int landmarks, double range_m)
      : points_(drawn_landmarks(landmarks)),
        vehicles_(drawn_team(robots, landmarks)),
        world_(point_world(vehicles_, 1)),
        clock_(rate_hz, 1e6),
        estimator_(filter_of(vehicles_)) {
    command_.bodies.assign(vehicles_.size(), BodyCommand{Eigen::Vector2d(speed_m_s, speed_m_s / radius_m)});
    SensorSet everything = point_sensors(vehicles_, {points_}, 2);
    for (SimulatedVehicle& v : vehicles_) v.sensor.limits.max_range_m = range_m;
    sensors_.emplace(point_sensors(vehicles_, {points_, true}, 1));
    tick_ = clock_.next();
    truth_ = world_.move(command_, tick_);
    seen_ = everything.measure(truth_, tick_);
    for (std::size_t i = 1; i < seen_.bodies.size(); ++i) seen_.bodies[i].landmarks.clear();
    update();
  }

  /// Generates the next motion and measurements; not part of a tick's cost.
  void listen() {
    tick_ = clock_.next();
    truth_ = world_.move(command_, tick_);
    seen_ = sensors_->measure(truth_, tick_);
  }
  void update() { estimator_.update(estimate_, command_, seen_, tick_); }

  const Estimate& estimate() const { return estimate_; }
  const Belief& belief() const { return std::get<Belief>(estimate_.belief.form()); }
  const Observation& seen() const { return seen_; }
  /// The last measurements, linearized at the current means, grouped by robot.
  std::vector<std::vector<LinearizedMeasurement>> measurements() const {
    std::vector<std::vector<LinearizedMeasurement>> all(seen_.bodies.size());
    const auto add = [&](std::size_t robot, bool of_vehicle, const PointDetection& s) {
      const auto at =
          linearize_detection(estimate_, static_cast<int>(robot), of_vehicle, s, estimator_.settings());
      if (at) all[robot].push_back(at->linearized);
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (const PointDetection& s : seen_.bodies[i].landmarks) add(i, false, s);
      for (const PointDetection& s : seen_.bodies[i].vehicles) add(i, true, s);
    }
    return all;
  }
  double error_m() const {
    double worst = 0;
    for (std::size_t i = 0; i < vehicles_.size(); ++i)
      worst = std::max(worst, (Eigen::Vector2d(estimate_.belief.mean(estimate_.bodies[i].block).head<2>()) -
                               Eigen::Vector2d(truth_->bodies[i].state.head<2>()))
                                  .norm());
    return worst;
  }

 private:
  PointLandmarks points_;
  std::vector<SimulatedVehicle> vehicles_;
  SimulatedWorld world_;
  std::optional<SensorSet> sensors_;
  FixedRateClock clock_;
  SlamEstimator estimator_;
  Estimate estimate_;
  Command command_;
  Tick tick_;
  std::optional<Truth> truth_;
  Observation seen_;
};

/// Eigen's rank update of one triangle of the size of the team covariance.
struct Bare {
  Eigen::MatrixXd P, W;
  explicit Bare(int errors) : P(Eigen::MatrixXd::Identity(errors, errors)) {}
  double seconds_of(int rank) {
    W.setConstant(P.rows(), rank, 1e-9);
    return processor_seconds([&] { P.selfadjointView<Eigen::Lower>().rankUpdate(W, -1.0); });
  }
};

/// Detections per robot and tick.
struct Sights {
  double landmarks = 0, others = 0, ticks = 0;
  void add(const Observation& observation) {
    for (const BodyObservation& view : observation.bodies) {
      landmarks +=
          static_cast<double>(view.landmarks.size()) / static_cast<double>(observation.bodies.size());
      others += static_cast<double>(view.vehicles.size()) / static_cast<double>(observation.bodies.size());
    }
    ++ticks;
  }
  void report(benchmark::State& state) const {
    state.counters["landmarks_seen"] = landmarks / ticks;
    state.counters["others_seen"] = others / ticks;
  }
};

double p99(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() * 99 / 100];
}

/// Arguments: robots, landmarks, range in meters.
Team team_of(const benchmark::State& state) {
  return {static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
          static_cast<double>(state.range(2))};
}

void tick(benchmark::State& state) {
  Team team = team_of(state);
  Bare bare(team.belief().errors());
  Sights sights;
  std::vector<double> wall, processor, ratios, measurements;
  std::map<std::string, std::vector<double>> stages;
  for (auto _ : state) {
    team.listen();
    double own = 0;
    wall.push_back(seconds([&] { own = processor_seconds([&] { team.update(); }); }));
    processor.push_back(own);
    ratios.push_back(own / bare.seconds_of(team.estimate().last.update.rows));
    for (const auto& [stage, ms] : team.estimate().timing_ms) stages[stage].push_back(ms);
    measurements.push_back(team.estimate().last.matched);
    sights.add(team.seen());
    state.SetIterationTime(own);
  }
  for (const auto& [stage, times] : stages) state.counters[stage] = median(times);
  sights.report(state);
  state.counters["looks"] = median(measurements);
  state.counters["states"] = team.belief().errors();
  state.counters["processor_ms"] = 1e3 * median(processor);
  state.counters["processor_p99"] = 1e3 * p99(processor);
  state.counters["wall_ms"] = 1e3 * median(wall);
  state.counters["wall_p99"] = 1e3 * p99(wall);
  state.counters["ratio"] = median(ratios);
  state.counters["error_m"] = team.error_m();  // checks that the filter still works
}

/// The textbook update on dense matrices: (A.2.5), (A.2.6).
struct Textbook {
  Eigen::MatrixXd P;
  void update(const Belief& layout, const std::vector<LinearizedMeasurement>& measurements) {
    Eigen::Index rows = 0, row = 0;
    for (const LinearizedMeasurement& measurement : measurements) rows += measurement.rows();
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows, P.rows()), R = Eigen::MatrixXd::Zero(rows, rows);
    for (const LinearizedMeasurement& measurement : measurements) {
      for (int i = 0; i < measurement.part_count; ++i) {
        const LinearizedMeasurement::Part& part = measurement.parts[static_cast<std::size_t>(i)];
        H.block(row, layout.offset(part.block), measurement.rows(), part.H.cols()) += part.H;
      }
      R.block(row, row, measurement.rows(), measurement.rows()) = measurement.R;
      row += measurement.rows();
    }
    const Eigen::MatrixXd PHt = P * H.transpose(), S = H * PHt + R;
    const Eigen::MatrixXd K = S.llt().solve(PHt.transpose()).transpose();
    P.noalias() -= K * PHt.transpose();
  }
};

/// The same measurements in one joint update (`ours`), one update per robot, one per measurement, and the
/// textbook form.
void ways(benchmark::State& state) {
  Team team = team_of(state);
  team.listen();
  team.update();
  const std::vector<std::vector<LinearizedMeasurement>> by_robot = team.measurements();
  std::vector<LinearizedMeasurement> all;
  for (const auto& measurements : by_robot) all.insert(all.end(), measurements.begin(), measurements.end());
  Belief at_once = team.belief(), by_robots = at_once, by_measurements = at_once;
  Textbook textbook{at_once.dense_covariance()};
  std::vector<double> ours, robots, measurements, dense;
  for (auto _ : state) {
    ours.push_back(processor_seconds([&] { at_once.update(all); }));
    robots.push_back(processor_seconds([&] {
      for (const auto& of_robot : by_robot) by_robots.update(of_robot);
    }));
    measurements.push_back(processor_seconds([&] {
      for (const LinearizedMeasurement& measurement : all) by_measurements.update({&measurement, 1});
    }));
    dense.push_back(processor_seconds([&] { textbook.update(at_once, all); }));
    state.SetIterationTime(ours.back());
  }
  state.counters["looks"] = static_cast<double>(all.size());
  for (const auto& [name, times] :
       {std::pair{"at_once", &ours}, {"by_robot", &robots}, {"by_look", &measurements}, {"textbook", &dense}})
    state.counters[name] = 1e3 * median(*times);
  // All variants must agree.
  const Eigen::MatrixXd P = at_once.dense_covariance();
  const auto apart = [&](const Eigen::MatrixXd& other) {
    return (P - other).cwiseAbs().maxCoeff() / P.maxCoeff();
  };
  state.counters["apart"] = std::max(
      {apart(by_robots.dense_covariance()), apart(by_measurements.dense_covariance()), apart(textbook.P)});
}

BENCHMARK(tick)->Args({20, 500, 8})->UseManualTime()->Iterations(300)->Unit(benchmark::kMillisecond);
// Variation of the number of measurements, of the map size and of the team size.
BENCHMARK(tick)
    ->Args({20, 500, 2})
    ->Args({20, 500, 4})
    ->Args({20, 500, 12})
    ->Args({20, 500, 16})
    ->Args({20, 125, 8})
    ->Args({20, 250, 8})
    ->Args({20, 1000, 8})
    ->Args({20, 2000, 8})
    ->Args({1, 500, 8})
    ->Args({5, 500, 8})
    ->Args({10, 500, 8})
    ->Args({40, 500, 8})
    ->UseManualTime()
    ->Iterations(30)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(ways)->Args({20, 500, 8})->UseManualTime()->Iterations(10)->Unit(benchmark::kMillisecond);

}  // namespace
