// Figure 5.11: where the landmarks' covariances go.
//
// Experiment: the runs of Example 5.3, and three seeds of it for 400 s with the EKF and with first-estimate
// Jacobians. The caption says one vehicle, the text two; here there are two. No trace may rise by more than
// 1e-9 of itself; it settles when it is within a quarter of the least (example_5_3.hpp) after 80 s, and not
// below it, to 1 %, at any time.
#include "experiments/closed_loop_statistics.hpp"
#include "experiments/common.hpp"
#include "experiments/example_5_2.hpp"
#include "experiments/example_5_3.hpp"
#include "incognita/analysis/evaluation/median.hpp"
#include "incognita/models/sensors/range_bearing.hpp"

namespace incognita::section_5_3 {
namespace {

using namespace closed_loop;

/// How a point moves with the frame, by a shift and a turn about the origin.
Eigen::Matrix<double, 2, 3> by_frame(const Vector2d& p) {
  Eigen::Matrix<double, 2, 3> J;
  J << 1, 0, -p.y(), 0, 1, p.x();
  return J;
}

/// Information of all measurements along the path about its start, in a known map: inverse covariance of the
/// first pose. Backward from the end, along the path without noise.
Matrix3d information_of_start(const Setup& setup, const Robot& robot) {
  const section_5_2::Way way = section_5_2::follow(robot.steering.path, robot.start, setup.duration_s);
  const Matrix2d Q = input_sigmas.cwiseAbs2().asDiagonal();
  const Vector2d weight = measurement_sigmas.cwiseAbs2().cwiseInverse();
  Matrix3d Y = Matrix3d::Zero();
  for (std::size_t k = way.poses.size(); k-- > 0;) {
    const planar::Step step = body.step(way.poses[k], way.inputs[k], period_s);
    // (Y^-1 + G Q G')^-1 without the inverse of Y, which is singular at first
    const Matrix3d kept = (Matrix3d::Identity() + Y * step.G * Q * step.G.transpose()).inverse() * Y;
    Y = step.F.transpose() * kept * step.F;
    if (k % ticks_per_scan != 0) continue;
    for (const auto& [identity, point] : setup.place) {
      const auto prediction = RangeBearing::predict_measurement(way.poses[k], Vector2d(point));
      if (std::abs(prediction->z[1]) <= pi / 2)
        Y += prediction->Hv.transpose() * weight.asDiagonal() * prediction->Hv;
    }
  }
  return Y;
}

/// The largest rise of a trace from one tick to the next, relative.
double largest_rise(const Run& run) {
  double rise = 0;
  for (std::size_t k = 1; k < run.instants.size(); ++k)
    for (std::size_t l = 0; l < run.instants[k].traces.size(); ++l) {
      const double before = run.instants[k - 1].traces[l], now = run.instants[k].traces[l];
      if (std::isfinite(before)) rise = std::max(rise, now / before - 1);
    }
  return rise;
}

Claim never_rise(const Runs& runs) {
  const double rise = quantile(each(runs, largest_rise), 1);
  return assessed(
      "5.3-traces-fall", "Figure 5.11",
      "All landmark localization uncertainties decrease as the algorithm proceeds: no trace ever rises, to "
      "1e-9 of itself",
      {.rule = Rule::example,
       .measured = {"largest relative rise of any landmark at any tick of any seed: {}", below(rise)},
       .runs = runs.size()},
      rise <= 1e-9);
}

/// Last traces over the least, by landmark.
std::vector<double> last_over_least(const Run& run, const std::vector<double>& least) {
  std::vector<double> ratios;
  for (std::size_t l = 0; l < least.size(); ++l)
    if (const double last = run.instants.back().traces[l]; std::isfinite(last))
      ratios.push_back(last / least[l]);
  return ratios;
}

/// Of all landmarks of many runs; the median is that of the runs' medians.
struct Settled {
  double lowest, highest;
  Interval median;
  Settled(const Runs& runs, const std::vector<double>& least) {
    const auto of_runs = [&](double share) {
      return each(runs, [&](const Run& run) { return quantile(last_over_least(run, least), share); });
    };
    lowest = std::ranges::min(of_runs(0)), highest = std::ranges::max(of_runs(1));
    median = median_interval(of_runs(0.5));
  }
  std::string text() const {
    return fmt::format("{:.2f} to {:.2f} times (median {:.2f})", lowest, highest, median.value);
  }
  bool stays_above() const { return lowest >= 0.99; }
};

Claim settle(const ExperimentSettings& settings, const Runs& runs) {
  const std::vector<double> least = least_traces(two_circles());
  const auto [low, high] = std::ranges::minmax_element(least);
  const auto longer = [&](Linearization linearization, const char* name) {
    Setup setup = two_circles();
    setup.duration_s = 400;
    setup.linearization = linearization;
    return Settled(runs_of(few(settings), std::string("5.3, 400 s, ") + name, setup), least);
  };
  const Settled usual(runs, least), ekf = longer(Linearization::analytic, "analytic"),
                                    first = longer(Linearization::first_estimate, "first-estimate");
  return assessed(
      "5.3-traces-settle", "Figure 5.11, below (5.23)",
      "The landmarks' traces reach an asymptotic minimum, the least that the starts leave open: "
      "they come within a quarter of it in 80 s and never fall below it",
      {.rule = Rule::equality,
       .measured = {"least {:.4f} to {:.4f} m^2 by landmark. After 80 s {}; after 400 s, {} "
                    "seeds, {}; with first-estimate Jacobians {}",
                    *low, *high, usual.text(), few(settings).seeds, ekf.text(), first.text()},
       .number = ClaimNumber{"trace after 400 s over the least, EKF, median landmark", ekf.median},
       .why = "with first-estimate Jacobians. So it is within the time of the figure, too, but "
              "the EKF, whose Jacobians are at changing estimates, falls below what the starts "
              "leave open later",
       .seeds = few(settings).seeds},
      usual.highest < 1.25 && usual.stays_above() && ekf.stays_above(),
      on_condition(usual.highest < 1.25 && usual.stays_above() && first.highest < 1.25 &&
                   first.stays_above() && !ekf.stays_above()));
}

}  // namespace

std::vector<double> least_traces(const Setup& setup) {
  const Matrix3d known = start_sigmas.cwiseAbs2().asDiagonal();
  Matrix3d of_frame = Matrix3d::Zero();  // information
  for (const Robot& robot : setup.robots) {
    Matrix3d J = Matrix3d::Identity();
    J.topRows<2>() = by_frame(robot.start.head<2>());
    of_frame += J.transpose() * (known + information_of_start(setup, robot).inverse()).inverse() * J;
  }
  const Matrix3d frame = of_frame.inverse();
  std::vector<double> traces;
  for (const auto& [identity, point] : setup.place) {
    const Eigen::Matrix<double, 2, 3> J = by_frame(Vector2d(point));
    traces.push_back((J * frame * J.transpose()).trace());
  }
  return traces;
}

std::vector<Claim> map_claims(const ExperimentSettings& settings, const Runs& runs) {
  return {never_rise(runs), settle(settings, runs)};
}

Plot traces_figure(const Run& run) {
  Panel panel{"", "time, s", "trace of the covariance, m^2", {}};
  panel.log_y = true;
  const std::vector<double> least = least_traces(two_circles());
  for (std::size_t l = 0; l < least.size(); ++l) {
    panel.curves.push_back(curve_of(l == 0 ? "landmarks" : "", Style::thin, Color::blue, run.instants,
                                    &Instant::t_s, [&](const Instant& i) { return i.traces[l]; }));
  }
  const auto [low, high] = std::ranges::minmax_element(least);
  const double end_s = run.instants.back().t_s;
  const std::string label = "least of the nearest and of the farthest";
  panel.curves.push_back({label, Style::dashed, {0, end_s}, {*low, *low}, {}, Color::orange});
  panel.curves.push_back({"", Style::dashed, {0, end_s}, {*high, *high}, {}, Color::orange});
  return {"fig-5.11", "Two robots: traces of the landmarks' covariances", 1, {panel}};
}

}  // namespace incognita::section_5_3
