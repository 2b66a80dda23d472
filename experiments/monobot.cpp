#include "experiments/monobot.hpp"

#include <limits>
#include <span>
#include <stdexcept>

#include "experiments/common.hpp"
#include "experiments/linear_filter.hpp"
#include "incognita/belief/belief.hpp"
#include "incognita/belief/linearize.hpp"
#include "incognita/models/motion/monobot.hpp"

namespace incognita::monobot {
namespace {

constexpr double dt = 1;  // so that a speed is a displacement, as in (3.4)

MatrixXd scalar(double value) { return MatrixXd::Constant(1, 1, value); }

/// The belief with the models of the monobot. Measurements are in the order of (3.12): anchor, landmarks.
class Filter {
 public:
  Filter(const Setup& setup, const VectorXd& first_estimate) : setup_(setup), belief_(states(setup)) {
    robot_ = belief_.add_vehicle(MonobotMotion::chart, first_estimate.head(1), scalar(setup.robot_var_m2));
    for (int i = 1; i < first_estimate.size(); ++i)
      landmarks_.push_back(setup.landmark_var_m2 ? with_variance(first_estimate.segment(i, 1))
                                                 : initialized(first_estimate.segment(i, 1)));
  }

  void predict() {
    const auto Q = MonobotMotion::Jacobian(setup_.sigma_v_m * setup_.sigma_v_m);
    const auto no_command = MonobotMotion::Input<double>(0.0);
    belief_.predict(linearized(MonobotMotion{}, belief_, robot_, no_command, Q, dt));
  }

  /// dP of (3.26)
  MatrixXd decorrelate() {
    if (setup_.decorrelated == Decorrelated::nothing) return {};
    const MatrixXd before = belief_.dense_covariance();
    belief_.decorrelate(setup_.decorrelated == Decorrelated::everything ? Belief::Scope::everything
                                                                        : Belief::Scope::map);
    return belief_.dense_covariance() - before;
  }

  /// Column by column: the correction if that measurement alone were 1 m more than expected.
  MatrixXd gain() {
    std::vector<LinearizedMeasurement> unit = measurements(expected());
    std::vector<BlockId> blocks{robot_};
    blocks.insert(blocks.end(), landmarks_.begin(), landmarks_.end());
    MatrixXd K(blocks.size(), unit.size());
    std::vector<BlockVector> moved(blocks.size());
    for (std::size_t j = 0; j < unit.size(); ++j) {
      unit[j].residual[0] = 1;
      if (!belief_.correction(unit, blocks, moved))
        throw std::runtime_error("the innovation covariance of the monobot is singular");
      unit[j].residual[0] = 0;
      for (std::size_t i = 0; i < blocks.size(); ++i) K(i, j) = moved[i][0];
    }
    return K;
  }

  void update(const VectorXd& z) {
    const auto report = belief_.update(measurements(z));
    if (report.outcome != UpdateReport::Outcome::updated)
      throw std::runtime_error("the innovation covariance of the monobot is singular");
  }

  VectorXd expected() const {
    const VectorXd x = estimate();
    VectorXd z(x.size() - (setup_.anchored ? 0 : 1));
    if (setup_.anchored) z[0] = RelativePosition::predict_measurement(x[0], 0).z[0];
    for (int i = 1; i < x.size(); ++i)
      z[z.size() - x.size() + i] = RelativePosition::predict_measurement(x[0], x[i]).z[0];
    return z;
  }

  VectorXd estimate() const {
    VectorXd x(states(setup_));
    x[0] = belief_.mean(robot_)[0];
    for (std::size_t i = 0; i < landmarks_.size(); ++i) x[i + 1] = belief_.mean(landmarks_[i])[0];
    return x;
  }

  MatrixXd covariance() const { return belief_.dense_covariance(); }

 private:
  BlockId with_variance(const VectorXd& mean) {
    return belief_.augment(Chart::line(1), mean, {}, scalar(*setup_.landmark_var_m2));
  }

  BlockId initialized(const VectorXd& mean) {
    const RelativePosition::Initialization initialization;
    const Belief::Parent parent{robot_, initialization.Jv};
    const double R = setup_.sigma_w_m * setup_.sigma_w_m;
    return belief_.augment(Chart::line(1), mean, {&parent, 1},
                           initialization.Jz * R * initialization.Jz.transpose());
  }

  std::vector<LinearizedMeasurement> measurements(const VectorXd& z) const {
    const VectorXd residual = z - expected();
    std::vector<LinearizedMeasurement> measurements(residual.size());
    const RelativePosition::Prediction model{};
    const std::size_t anchors = measurements.size() - landmarks_.size();
    for (std::size_t i = 0; i < measurements.size(); ++i) {
      measurements[i].add(robot_, model.Hv);
      if (i >= anchors) measurements[i].add(landmarks_[i - anchors], model.Hl);
      measurements[i].residual = residual.segment(i, 1);
      measurements[i].R = scalar(setup_.sigma_w_m * setup_.sigma_w_m);
    }
    return measurements;
  }

  Setup setup_;
  Belief belief_;
  BlockId robot_ = 0;
  std::vector<BlockId> landmarks_;
};

/// What chance does to one run: each source has its own stream, so that runs with other setups can be paired.
class MonobotWorld {
 public:
  MonobotWorld(const Setup& setup, std::uint64_t seed)
      : setup_(setup), truth_(VectorXd::Constant(states(setup), landmark_m)), first_(named(seed, "first")) {
    truth_[0] = robot_start_m;
    motion_ = named(seed, "motion");
    if (setup.anchored) measurements_.push_back(named(seed, "anchor"));
    for (int i = 1; i <= setup.landmarks; ++i)
      measurements_.push_back(named(seed, fmt::format("landmark {}", i)));
  }

  VectorXd first_estimate() {
    VectorXd x = truth_;
    x[0] += std::sqrt(setup_.robot_var_m2) * first_.normal();
    for (int i = 1; i < x.size(); ++i)
      x[i] = setup_.landmark_var_m2 ? landmark_m + std::sqrt(*setup_.landmark_var_m2) * first_.normal()
                                    : RelativePosition::initialize(x[0], first_measurement(i)).landmark[0];
    return x.array() + setup_.shift_m;
  }

  void move() { truth_[0] += setup_.sigma_v_m * motion_.normal(); }

  VectorXd measure() {
    VectorXd z(static_cast<Index>(measurements_.size()));
    const Index anchors = z.size() - setup_.landmarks;
    for (Index i = 0; i < z.size(); ++i) {
      const double place = i < anchors ? 0 : truth_[i - anchors + 1];
      z[i] = RelativePosition::predict_measurement(truth_[0], place).z[0] +
             setup_.sigma_w_m * measurements_[i].normal();
    }
    if (!looked_) z[anchors] += setup_.first_measurement_error_m;
    looked_ = true;
    return z;
  }

  const VectorXd& truth() const { return truth_; }

 private:
  static RandomStream named(std::uint64_t seed, const std::string& source) {
    return {seed, "monobot " + source};
  }

  double first_measurement(int landmark) {
    return RelativePosition::predict_measurement(truth_[0], truth_[landmark]).z[0] +
           setup_.sigma_w_m * first_.normal();
  }

  Setup setup_;
  VectorXd truth_;
  RandomStream first_, motion_ = first_;
  std::vector<RandomStream> measurements_;
  bool looked_ = false;
};

std::vector<double> numbers(const VectorXd& row) { return {row.begin(), row.end()}; }

// The four rows of Figures 3.4, 3.8, 3.12, 3.15 and 3.18 ----------------------------------------------

Panel states_panel(const Run& run) {
  Panel p{run.truth.rows() == 2 ? "one landmark" : "two landmarks", "step", "position, m", {}};
  for (Index i = 0; i < run.truth.rows(); ++i) {
    const std::string what = i == 0                  ? "robot"
                             : run.truth.rows() == 2 ? "landmark"
                                                     : fmt::format("landmark {}", i);
    p.curves.push_back(over_steps(what, numbers(run.estimate.row(i))));
  }
  for (Index i = 0; i < std::min<Index>(run.truth.rows(), 2); ++i) {  // landmarks are all there
    p.curves.push_back(over_steps(i == 0 ? "truth" : "", numbers(run.truth.row(i)), Style::dashed));
    p.curves.back().color = Color::ink;
  }
  return p;
}

/// Errors of the states from `first` to `last`, after each update, in the band of the first's 2 sigma.
Panel errors_panel(const Run& run, Index first, Index last, const std::string& y_label) {
  Panel p{"", "step", y_label, {}};
  const Index steps = run.truth.cols() - 1;
  const VectorXd bound = 2 * run.variance.row(first).tail(steps).cwiseSqrt().transpose();
  Curve band = over_steps("2 sigma", numbers(-bound), Style::band, 1);
  band.y2 = numbers(bound);
  band.color = Color::gray;
  p.curves.push_back(band);
  for (Index i = first; i <= last; ++i)
    p.curves.push_back(over_steps(first == last ? "error" : fmt::format("error {}", i),
                                  numbers(run.error().row(i).tail(steps)), Style::line, 1));
  return p;
}

/// Gains of the robot and the first landmark. Measurements are counted as in (3.12): z0 is the anchor's. The
/// robot's gains by all landmarks are alike.
Panel gains_panel(const Setup& setup, const Course& course) {
  Panel p{"", "step", "gain", {}};
  const int first = setup.anchored ? 0 : 1;
  for (int state = 0; state < 2; ++state)
    for (int measurement = first; measurement <= (state == 0 ? 1 : setup.landmarks); ++measurement) {
      std::vector<double> gains;
      for (std::size_t k = 1; k < course.gain.size(); ++k)
        gains.push_back(course.gain[k](state, measurement - first));
      const std::string label = fmt::format("{} by z{}", state == 0 ? "robot" : "landmark 1", measurement);
      p.curves.push_back(over_steps(label, gains, Style::line, 1));
    }
  return p;
}

double nees(const VectorXd& error, const MatrixXd& P) {
  const Eigen::LLT<MatrixXd> llt(P);
  if (llt.info() != Eigen::Success) return std::numeric_limits<double>::quiet_NaN();
  return error.dot(llt.solve(error)) / static_cast<double>(error.size());
}

}  // namespace

const char* name(Decorrelated what) { return what == Decorrelated::map ? "map" : "everything"; }

int states(const Setup& setup) { return 1 + setup.landmarks; }

LinearSystem system(const Setup& setup) {
  const int n = states(setup), first = setup.anchored ? 1 : 0, measurements = first + setup.landmarks;
  LinearSystem s;
  s.F = MatrixXd::Identity(n, n);
  s.G = VectorXd::Unit(n, 0);
  s.Q = scalar(setup.sigma_v_m * setup.sigma_v_m);
  s.H = MatrixXd::Zero(measurements, n);
  s.H.col(0).setConstant(-1);
  s.H.bottomRightCorner(setup.landmarks, setup.landmarks).setIdentity();
  s.R = setup.sigma_w_m * setup.sigma_w_m * MatrixXd::Identity(measurements, measurements);
  return s;
}

LinearSystem with_pseudo_noise(const LinearSystem& system, const MatrixXd& dP) {
  LinearSystem noisy = system;
  const Index n = system.F.rows(), m = system.Q.rows();
  noisy.G.resize(n, m + n);
  noisy.G << system.G, MatrixXd::Identity(n, n);
  noisy.Q = MatrixXd::Zero(m + n, m + n);
  noisy.Q.topLeftCorner(m, m) = system.Q;
  noisy.Q.bottomRightCorner(n, n) = dP;
  return noisy;
}

Rank excited(const Setup& setup, const MatrixXd& dP) {
  // of the sum, which spans the same; each scaled, because only directions count
  const MatrixXd noise = dP / std::max(dP.norm(), std::numeric_limits<double>::min());
  const MatrixXd robot = VectorXd::Unit(states(setup), 0) * VectorXd::Unit(states(setup), 0).transpose();
  return rank_of(robot + noise, 1e-6);
}

MatrixXd first_covariance(const Setup& setup) {
  return Filter(setup, VectorXd::Zero(states(setup))).covariance();
}

Course course(const Setup& setup) {
  Filter filter(setup, VectorXd::Zero(states(setup)));
  Course course{{{}}, {{}}, {{}}, {filter.covariance()}};
  for (int k = 1; k <= setup.steps; ++k) {
    filter.predict();
    course.inflation.push_back(filter.decorrelate());
    course.prior.push_back(filter.covariance());
    course.gain.push_back(filter.gain());
    filter.update(filter.expected());
    course.posterior.push_back(filter.covariance());
  }
  return course;
}

std::vector<MatrixXd> actual_covariances(const Setup& setup, const Course& course) {
  const LinearSystem s = system(setup);
  std::vector<MatrixXd> actual{course.posterior[0]};
  for (std::size_t k = 1; k < course.gain.size(); ++k)
    actual.push_back(updated(s, predicted(s, actual.back()), course.gain[k]));  // right for any gain: (A.2.7)
  return actual;
}

Run simulate(const Setup& setup, std::uint64_t seed) {
  MonobotWorld world(setup, seed);
  Filter filter(setup, world.first_estimate());
  const MatrixXd empty = MatrixXd::Zero(states(setup), setup.steps + 1);
  Run run{empty, empty, empty, MatrixXd::Zero(filter.expected().size(), setup.steps + 1),
          VectorXd(setup.steps + 1)};
  const auto keep = [&](int k) {
    const MatrixXd P = filter.covariance();
    run.truth.col(k) = world.truth();
    run.estimate.col(k) = filter.estimate();
    run.variance.col(k) = P.diagonal();
    run.nees[k] = nees(run.truth.col(k) - run.estimate.col(k), P);
  };
  keep(0);
  for (int k = 1; k <= setup.steps; ++k) {
    world.move();
    filter.predict();
    filter.decorrelate();
    run.measurement.col(k) = world.measure();
    filter.update(run.measurement.col(k));
    keep(k);
  }
  return run;
}

std::vector<Run> simulate_all(const Setup& setup, int count) {
  return over_seeds(count, [&](std::uint64_t seed) { return simulate(setup, seed); });
}

bool smaller_variances(const std::vector<MatrixXd>& a, const std::vector<MatrixXd>& b) {
  for (std::size_t k = 1; k < b.size(); ++k)
    if (!(a[k].diagonal().array() < b[k].diagonal().array()).all()) return false;
  return true;
}

std::vector<double> errors(const std::vector<Run>& runs, int state, int step) {
  return each(runs, [&](const Run& run) { return run.truth(state, step) - run.estimate(state, step); });
}

std::vector<double> squares_less(const std::vector<double>& fewer, const std::vector<double>& more) {
  std::vector<double> less;
  for (std::size_t i = 0; i < more.size(); ++i) less.push_back(more[i] * more[i] - fewer[i] * fewer[i]);
  return less;
}

Claim consistent(const std::string& id, const std::string& place, Setup setup, int seeds) {
  Interval of_one;
  const Cases cases = by_number({1, 2}, [&](int n) -> CaseResult {
    setup.landmarks = n;
    const Interval nees =
        mean_of(each(simulate_all(setup, seeds), [&](const Run& run) { return run.nees[setup.steps]; }));
    if (n == 1) of_one = nees;
    return {text(nees), is_consistent(nees)};
  });
  return assessed(
      id, place,
      "The filter is consistent: mean NEES over its degrees of freedom after the last step within 0.2 of 1",
      {.rule = Rule::equality,
       .measured = "by number of landmarks: " + cases.text(),
       .number = ClaimNumber{"mean NEES, one landmark", of_one},
       .seeds = seeds},
      cases.hold());
}

Claim inflated(const std::string& id, const Setup& setup, int seeds) {
  const Course dropped = course(setup);
  Setup kept = setup;
  kept.decorrelated = Decorrelated::nothing;
  const MatrixXd said = dropped.posterior.back(), actual = actual_covariances(setup, dropped).back(),
                 best = course(kept).posterior.back();
  const double margin = smallest_eigenvalue(said - actual), loss = smallest_eigenvalue(actual - best);
  const Interval rms = rms_of(errors(simulate_all(setup, seeds), 1, setup.steps));
  const double actual_sigma = std::sqrt(actual(1, 1));
  const Answer as_computed = agrees(rms, actual_sigma, 0.2 * actual_sigma);
  return assessed(
      id, "Section 3.3",
      "The filter is suboptimal, and its covariances are inflated: they exceed the actual error covariance "
      "(errors over runs as computed, to a fifth), which exceeds that of the optimal filter (no eigenvalue "
      "of the differences below -1e-12 m^2)",
      {.rule = Rule::superiority,
       .measured = {"after {} steps with {} landmark{}, landmark: {:.3f} m by the filter, {:.3f} m actual, "
                    "{} over runs, {:.3f} m optimal; robot: {:.3f}, {:.3f}, {:.3f} m",
                    setup.steps, setup.landmarks, setup.landmarks == 1 ? "" : "s", std::sqrt(said(1, 1)),
                    std::sqrt(actual(1, 1)), text(rms, "m"), std::sqrt(best(1, 1)), std::sqrt(said(0, 0)),
                    std::sqrt(actual(0, 0)), std::sqrt(best(0, 0))},
       .number = exactly("landmark's variance by the filter over the actual one", said(1, 1) / actual(1, 1)),
       .seeds = seeds},
      std::min(margin, loss) >= -1e-12 && said.trace() > 1.01 * actual.trace() && as_computed);
}

double relative_variance(double sigma_v_m, double sigma_w_m, int landmarks) {
  const double v2 = sigma_v_m * sigma_v_m, w2 = sigma_w_m * sigma_w_m / landmarks;
  return (v2 + std::sqrt(v2 * v2 + 4 * v2 * w2)) / 2;
}

MatrixXd settled_prior(const Setup& setup) {
  const int n = states(setup);
  const double p = relative_variance(setup.sigma_v_m, setup.sigma_w_m, setup.landmarks);
  const double a = setup.robot_var_m2;
  double of_all =
      a + p - setup.sigma_v_m * setup.sigma_v_m;  // initialized landmarks: there is no other prior
  if (setup.landmark_var_m2) {
    const double b = *setup.landmark_var_m2 / setup.landmarks;  // of their mean
    of_all = b * (a + p) / (a + b + p);
  }
  MatrixXd P = MatrixXd::Constant(n, n, of_all);
  P(0, 0) += p;
  return P;
}

Plot eigenvalue_surfaces(const std::string& id, const std::string& title,
                         const std::vector<EigenvaluePanel>& panels) {
  Plot plot{id, title, 2, {}};
  std::vector<double> grid;
  for (int i = 1; i <= 20; ++i) grid.push_back(0.1 * i);
  for (const EigenvaluePanel& from : panels) {
    Panel panel{from.title, "s_v, m", "s_w, m", {}};
    panel.z_label = "eigenvalue";
    for (const std::string& label : from.labels) panel.surfaces.push_back({label, grid, grid, {}});
    for (const double w : grid)
      for (const double v : grid) {
        const std::vector<double> values = from.of(v, w);
        for (std::size_t i = 0; i < values.size(); ++i) panel.surfaces[i].z.push_back(values[i]);
      }
    plot.panels.push_back(panel);
  }
  return plot;
}

Plot four_rows(const std::string& id, const std::string& title, Setup setup) {
  Plot plot{id, title, 2, std::vector<Panel>(8)};
  for (int n = 1; n <= 2; ++n) {
    setup.landmarks = n;
    const Run run = simulate(setup, 1);
    plot.panels[n - 1] = states_panel(run);
    plot.panels[n + 1] = errors_panel(run, 0, 0, "robot's error, m");
    plot.panels[n + 3] = errors_panel(run, 1, n, "landmark's error, m");
    plot.panels[n + 5] = gains_panel(setup, course(setup));
  }
  return plot;
}

}  // namespace incognita::monobot
