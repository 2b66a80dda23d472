// Panels of Figures 6.4, 6.5, 6.7, 6.9, 6.10 and 6.13.
#include <cmath>

#include "experiments/exploring_comparison.hpp"
#include "incognita/analysis/evaluation/pose_consistency.hpp"

namespace incognita::exploring {
namespace {

/// One axis of an error, between its bounds.
Panel error_panel(const std::string& title, const std::string& unit, const Run& run, int axis) {
  Panel p{title, "t, s", unit, {}};
  Curve band{"2 sigma", Style::band, {}, {}, {}, Color::sky};
  Curve error{"error", Style::line, {}, {}, {}, Color::blue};
  for (const Instant& i : run.instants) {
    const double bound = 2 * std::sqrt(std::max(0.0, i.covariance(axis, axis)));
    band.x.push_back(i.t_s), band.y.push_back(-bound), band.y2.push_back(bound);
    error.x.push_back(i.t_s), error.y.push_back(pose_error(i.truth, i.estimate)[axis]);
  }
  p.curves = {band, error};
  return p;
}

}  // namespace

Panel from_above(const std::string& title, const Run& run) {
  Panel p{title, "x, m", "y, m", {}, true};
  const auto truth = path_of("camera", Style::line, Color::blue, run.instants,
                             [](const Instant&i) { return i.truth.position; }),
             estimated = path_of("estimated", Style::dashed, Color::orange, run.instants,
                                 [](const Instant&i) { return i.estimate.position; });
  Curve anchors{"anchors", Style::stars, {}, {}, {}, Color::ink};
  std::vector<Eigen::Vector2d> means;
  std::vector<Eigen::Matrix2d> covariances;
  for (const SnapshotLandmark& l : run.map) {
    if (l.anchor) {
      anchors.x.push_back(l.position.x()), anchors.y.push_back(l.position.y());
      continue;
    }
    means.emplace_back(l.position.head<2>());
    covariances.emplace_back(l.covariance.topLeftCorner<2, 2>());
  }
  p.curves = {ellipses("landmarks, 2 sigma", means, covariances), anchors, truth, estimated};
  p.x_range = p.y_range = {-3.2, 3.2};
  return p;
}

Panel choices(const std::string& title, const Run& run) {
  Panel p{title, "t, s", "", {}};
  p.curves = {curve_of("", Style::steps, Color::blue, run.decisions, &Decision::t_s, &Decision::chosen)};
  p.y_names = run.actions;
  p.y_range = {-0.5, static_cast<double>(run.actions.size()) - 0.5};
  return p;
}

Panel entropies(const std::string& title, const Run& run) {
  Panel p{title, "t, s", "entropy, nats", {}};
  Curve located{"located", Style::points, {}, {}, {}, Color::green};
  for (int n = 1; n <= static_cast<int>(run.located_t_s.size()); ++n) {
    located.x.push_back(*run.located_at_s(n));
    located.y.push_back(run.entropy_when_located(n).value_or(std::nan("")));
  }
  p.curves = {over_time("camera", run, Color::sky, [](const Instant& i) { return i.entropy.vehicle; }),
              over_time("map", run, Color::orange, [](const Instant& i) { return i.entropy.map; }),
              over_time("all", run, Color::ink, [](const Instant& i) { return i.entropy.total; }), located};
  return p;
}

Plot map_figure(const std::string& id, const std::string& title, const std::vector<std::string>& names,
                const std::vector<Runs>& of_strategies) {
  Plot plot{id, title, static_cast<int>(names.size()), {}};
  for (std::size_t s = 0; s < of_strategies.size(); ++s)
    plot.panels.push_back(from_above(names[s], of_strategies[s].front()));
  for (const Runs& runs : of_strategies) plot.panels.push_back(entropies("", runs.front()));
  return plot;
}

Plot error_figure(const std::string& id, const std::string& title, const std::vector<std::string>& names,
                  const std::vector<Runs>& of_strategies) {
  Plot plot{id, title, static_cast<int>(names.size()), {}};
  const char* axes[] = {"x, m", "y, m", "z, m", "about x, rad", "about y, rad", "about z, rad"};
  for (int axis = 0; axis < 6; ++axis)
    for (std::size_t s = 0; s < of_strategies.size(); ++s)
      plot.panels.push_back(
          error_panel(axis == 0 ? names[s] : "", axes[axis], of_strategies[s].front(), axis));
  return plot;
}

}  // namespace incognita::exploring
