// Figure 5.11: where the landmarks' covariances go.
//
// Experiment: the runs of Example 5.3, and three seeds of it for 400 s with the EKF and with first-estimate
// Jacobians. The caption says one vehicle, the text two; here there are two. No trace may rise by more than
// 1e-9 of itself; it settles when it is within a quarter of the least (example_5_3.hpp) after 80 s, and not
// below it, to 1 %, at any time.
#include <Eigen/LU>
#include <numbers>

#include "experiments/closed_loop_statistics.hpp"
#include "experiments/common.hpp"
#include "experiments/example_5_2.hpp"
#include "experiments/example_5_3.hpp"
#include "incognita/models/sensors/range_bearing.hpp"

namespace incognita::section_5_3 {
namespace {

using namespace closed_loop;
using Eigen::Matrix3d;

/// How a point moves with the frame, by a shift and a turn about the origin.
Eigen::Matrix<double, 2, 3> by_frame(const Eigen::Vector2d& p) {
  Eigen::Matrix<double, 2, 3> J;
  J << 1, 0, -p.y(), 0, 1, p.x();
  return J;
}

/// Information of all measurements along the path about its start, in a known map: inverse covariance of the
/// first pose. Backward from the end, along the path without noise.
Matrix3d information_of_start(const Setup& setup, const Robot& robot) {
  const section_5_2::Way way = section_5_2::follow(robot.steering.path, robot.start, setup.duration_s);
  const Eigen::Matrix2d Q = input_sigmas.cwiseAbs2().asDiagonal();
  const Eigen::Vector2d weight = measurement_sigmas.cwiseAbs2().cwiseInverse();
  Matrix3d Y = Matrix3d::Zero();
  for (std::size_t k = way.poses.size(); k-- > 0;) {
    const planar::Step step = body.step(way.poses[k], way.inputs[k], period_s);
    // (Y^-1 + G Q G')^-1 without the inverse of Y, which is singular at first
    const Matrix3d kept = (Matrix3d::Identity() + Y * step.G * Q * step.G.transpose()).inverse() * Y;
    Y = step.F.transpose() * kept * step.F;
    if (k % ticks_per_scan != 0) continue;
    for (const auto& [identity, point] : setup.place) {
      const auto prediction = RangeBearing::predict_measurement(way.poses[k], Eigen::Vector2d(point));
      if (std::abs(prediction->z[1]) <= std::numbers::pi / 2)
        Y += prediction->Hv.transpose() * weight.asDiagonal() * prediction->Hv;
    }
  }
  return Y;
}

Claim never_rise(const std::vector<Traces>& all) {
  const double rise = quantile(each(all, &Traces::rise), 1);
  return assessed("5.3-traces-fall", "Figure 5.11",
                  "All landmark localization uncertainties decrease as the algorithm proceeds: no trace ever "
                  "rises, to 1e-9 of itself",
                  {.printed = "decrease",
                   .measured = fmt::format(
                       "largest relative rise of any landmark at any tick of any seed: {}", below(rise)),
                   .runs = all.size()},
                  rise <= 1e-9);
}

/// Lowest, median and highest of many runs, as text, and whether none is below.
struct Span {
  double lowest, median, highest;
  explicit Span(const std::vector<Traces>& all)
      : lowest(quantile(each(all, &Traces::lowest), 0)),
        median(quantile(each(all, &Traces::median), 0.5)),
        highest(quantile(each(all, &Traces::highest), 1)) {}
  std::string text() const {
    return fmt::format("{:.2f} to {:.2f} times (median {:.2f})", lowest, highest, median);
  }
  bool stays_above() const { return lowest >= 0.99; }
};

Claim settle(const ExperimentSettings& settings, const std::vector<Traces>& all) {
  const std::vector<double> least = least_traces(two_circles());
  const auto [low, high] = std::ranges::minmax_element(least);
  ExperimentSettings few = settings;
  few.seeds = std::min(settings.seeds, enough_runs);
  const auto longer = [&](Linearization linearization, const char* name) {
    Setup setup = two_circles();
    setup.duration_s = 400;
    setup.linearization = linearization;
    return Span(over_seeds(few, std::string("5.3, 400 s, ") + name, setup,
                           [&](const Run& run) { return traces_of(run, least); }));
  };
  const Span usual(all), ekf = longer(Linearization::analytic, "analytic"),
                         first = longer(Linearization::first_estimate, "first-estimate");
  return assessed("5.3-traces-settle", "Figure 5.11, below (5.23)",
                  "The landmarks' traces reach an asymptotic minimum, the least that the starts leave open: "
                  "they come within a quarter of it in 80 s and never fall below it",
                  {.printed = "asymptotic minimum",
                   .measured = fmt::format("least {:.4f} to {:.4f} m^2 by landmark. After 80 s {}; after 400 "
                                           "s, {} seeds, {}; with first-estimate Jacobians {}",
                                           *low, *high, usual.text(), few.seeds, ekf.text(), first.text()),
                   .why = "so it is within the time of the figure, but the EKF falls below what is "
                          "observable: its Jacobians at changing estimates add spurious information about "
                          "the frame. With first-estimate Jacobians the minimum is reached",
                   .seeds = few.seeds},
                  usual.highest < 1.25 && usual.stays_above() && ekf.stays_above(),
                  usual.highest < 1.25 && usual.stays_above() && first.stays_above());
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
    const Eigen::Matrix<double, 2, 3> J = by_frame(Eigen::Vector2d(point));
    traces.push_back((J * frame * J.transpose()).trace());
  }
  return traces;
}

Traces traces_of(const Run& run, const std::vector<double>& least) {
  Traces out;
  std::vector<double> ratios;
  for (std::size_t l = 0; l < least.size(); ++l) {
    for (std::size_t k = 1; k < run.instants.size(); ++k) {
      const double before = run.instants[k - 1].traces[l], now = run.instants[k].traces[l];
      if (std::isfinite(before)) out.rise = std::max(out.rise, now / before - 1);
    }
    const double last = run.instants.back().traces[l];
    if (std::isfinite(last)) ratios.push_back(last / least[l]);
  }
  out.lowest = quantile(ratios, 0), out.median = quantile(ratios, 0.5), out.highest = quantile(ratios, 1);
  return out;
}

std::vector<Claim> map_claims(const ExperimentSettings& settings, const std::vector<Traces>& all) {
  return {never_rise(all), settle(settings, all)};
}

Plot traces_figure(const Run& run) {
  Panel panel;
  panel.x_label = "time, s";
  panel.y_label = "trace of the covariance, m^2";
  panel.log_y = true;
  const std::vector<double> least = least_traces(two_circles());
  for (std::size_t l = 0; l < least.size(); ++l) {
    Curve curve{l == 0 ? "landmarks" : "", Style::thin, {}, {}, {}, Color::blue};
    for (const Instant& i : run.instants) curve.x.push_back(i.t_s), curve.y.push_back(i.traces[l]);
    panel.curves.push_back(curve);
  }
  const auto [low, high] = std::ranges::minmax_element(least);
  const double end_s = run.instants.back().t_s;
  const std::string label = "least of the nearest and of the farthest";
  panel.curves.push_back({label, Style::dashed, {0, end_s}, {*low, *low}, {}, Color::orange});
  panel.curves.push_back({"", Style::dashed, {0, end_s}, {*high, *high}, {}, Color::orange});
  return {"fig-5.11", "Two robots: traces of the landmarks' covariances", 1, {panel}};
}

}  // namespace incognita::section_5_3
