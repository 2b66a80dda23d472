#include "experiments/exploring_figures.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/analysis/evaluation/pose_consistency.hpp"

namespace incognita::exploring {
namespace {

/// One axis of an error, between its bounds.
Panel error_panel(const std::string& title, const std::string& unit, const Run& run, int axis) {
  const auto lower = [&](const Instant& i) {
    return -2 * std::sqrt(std::max(0.0, i.covariance(axis, axis)));
  };
  const auto error = [&](const Instant& i) { return pose_error(i.truth, i.estimate)[axis]; };
  return time_panel(title, unit,
                    {band_of("2 sigma", Color::sky, run.instants, &Instant::t_s, lower),
                     over_time("error", run, Color::blue, error)});
}

}  // namespace

Panel from_above(const std::string& title, const Run& run) {
  Panel p{title, "x, m", "y, m", {}, true};
  std::vector<SnapshotLandmark> anchors, mapped;
  std::ranges::partition_copy(run.map, std::back_inserter(anchors), std::back_inserter(mapped),
                              &SnapshotLandmark::anchor);
  p.curves = {outlines_of("landmarks, 2 sigma", Color::automatic, mapped, &SnapshotLandmark::position,
                          &SnapshotLandmark::covariance),
              path_of("anchors", Style::stars, Color::ink, anchors, &SnapshotLandmark::position),
              path_of("camera", Style::line, Color::blue, run.instants,
                      [](const Instant& i) { return i.truth.position; }),
              path_of("estimated", Style::dashed, Color::orange, run.instants,
                      [](const Instant& i) { return i.estimate.position; })};
  p.x_range = p.y_range = {-3.2, 3.2};
  return p;
}

Panel choices(const std::string& title, const Run& run) {
  Panel p = time_panel(title, "");
  p.curves = {curve_of("", Style::steps, Color::blue, run.decisions, &Decision::t_s, &Decision::chosen)};
  p.y_names = run.actions;
  p.y_range = {-0.5, static_cast<double>(run.actions.size()) - 0.5};
  return p;
}

Panel entropies(const std::string& title, const Run& run) {
  Panel p = time_panel(title, "entropy, nats");
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

Plot map_figure(const std::string& id, const std::string& title, const std::vector<Runs>& runs) {
  Plot plot{id, title, static_cast<int>(runs.size()), {}};
  for (std::size_t s = 0; s < runs.size(); ++s)
    plot.panels.push_back(from_above(runs[s].name, runs[s].front()));
  for (const Runs& of_strategy : runs) plot.panels.push_back(entropies("", of_strategy.front()));
  return plot;
}

Plot error_figure(const std::string& id, const std::string& title, const std::vector<Runs>& runs) {
  Plot plot{id, title, static_cast<int>(runs.size()), {}};
  const char* axes[] = {"x, m", "y, m", "z, m", "about x, rad", "about y, rad", "about z, rad"};
  for (int axis = 0; axis < 6; ++axis)
    for (std::size_t s = 0; s < runs.size(); ++s)
      plot.panels.push_back(error_panel(axis == 0 ? runs[s].name : "", axes[axis], runs[s].front(), axis));
  return plot;
}

}  // namespace incognita::exploring
