// What bundle adjustment of a whole run makes of the filter's own matches: how far the error of a trajectory is one of
// linearization, and how far one of the matches.
//
//   adjusted_trajectory SCENARIO [--stride N] [--out FILE.tum] [--set key=value]...
//
// The scenario runs once. Every Nth frame then is a view; the positions in which the filter found its landmarks there are the
// measurements, its poses the start. Without a known target the scale is held by weak priors of the depths.
// Printed: the absolute trajectory error of both after a similarity transform, where the truth is known, the rms difference
// between them, and the residuals.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/app/loop/assembly.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/slam/bundle/adjust_bundle.hpp"
#include "incognita/slam/bundle/run_bundle.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/slam/features/predict_matches.hpp"

namespace incognita {
namespace {

struct Wanted {
  std::string scenario, out;
  int stride = 1;
  bool causal = false;
  std::vector<std::string> sets;
};

Wanted wanted_by(int argc, char** argv) {
  Wanted out;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&] { return std::string(i + 1 < argc ? argv[++i] : ""); };
    if (word == "--stride")
      out.stride = std::max(1, std::atoi(value().c_str()));
    else if (word == "--causal")
      out.causal = true;
    else if (word == "--out")
      out.out = value();
    else if (word == "--set")
      out.sets.push_back(value());
    else if (word.starts_with("--") || !out.scenario.empty()) {
      std::cerr << word << ": unknown option; see the head of bench/adjusted_trajectory.cpp\n";
      std::exit(2);
    } else {
      out.scenario = word;
    }
  }
  if (out.scenario.empty()) {
    std::cerr << "usage: adjusted_trajectory SCENARIO [--stride N] [--out FILE.tum] [--set key=value]...\n";
    std::exit(2);
  }
  return out;
}

struct Recorded {
  Trajectory estimate, truth;
  RunMatches matches;
  int lost = 0;
};

void record(const Estimate& estimate, const std::optional<Truth>& truth, double t, Recorded& out) {
  const CameraState x = estimate.camera_state();
  const int view = static_cast<int>(out.matches.views.size());
  out.matches.views.push_back(view_of(x));
  out.estimate.push_back({t, x.head<3>(), x.segment<4>(3)});
  if (truth && truth->bodies[0].pose)
    out.truth.push_back({t, truth->bodies[0].pose->position, truth->bodies[0].pose->world_from_body});
  for (const Match& match : estimate.last.matches) {
    if (!match.image || match.ray || match.outcome != MatchOutcome::matched) continue;
    out.matches.pixels[match.id].emplace_back(view, Eigen::Vector2d(match.measured));
    const auto landmark = estimate.landmarks.find(match.id);
    if (landmark != estimate.landmarks.end() && landmark->second.fixed)
      out.matches.known[match.id] = nominal_position(landmark->second, estimate.belief);
  }
}

Recorded run(const Wanted& wanted, std::optional<Camera>& camera) {
  std::vector<std::string> sets = wanted.sets;
  Assembly assembly = assemble(load_scenario(wanted.scenario, sets));
  LoopParts& parts = assembly.parts;
  Estimate estimate;
  Command command;
  Recorded out;
  int frame = 0;
  while (const Tick tick = parts.clock->next()) {
    const std::optional<Truth> truth = parts.world->move(command, tick);
    const Observation observation = parts.sensor->measure(truth, tick);
    parts.estimator->update(estimate, command, observation, tick);
    const Goal goal = parts.strategy->choose(estimate, observation, tick);
    command = parts.controller->act(estimate, goal, observation, tick);
    if (!estimate.started || observation.bodies[0].images.empty()) continue;
    out.lost += estimate.status.state == TrackingState::lost;
    // A view without matches is not determined
    const bool is_tracked = estimate.status.state != TrackingState::lost && estimate.last.image_matches >= 4;
    if (is_tracked && frame++ % wanted.stride == 0) record(estimate, truth, tick.t, out);
  }
  camera = dynamic_cast<const SlamEstimator&>(*parts.estimator).cameras()[0].camera().camera;
  return out;
}

double ate(const Trajectory& estimate, const Trajectory& truth, AlignmentKind kind) {
  const MatchedTrajectories matched = match(estimate, truth, 0.02);
  const auto alignment = align(matched, kind);
  if (!alignment) return std::nan("");
  return absolute_trajectory_error({aligned(matched.estimate, *alignment), matched.truth}).rmse;
}

void print_residuals(const char* what, const Bundle& bundle, const Camera& camera) {
  std::vector<double> r = residuals_px(bundle, camera);
  std::ranges::sort(r);
  const auto at = [&](double share) {
    return r[static_cast<std::size_t>(share * static_cast<double>(r.size() - 1))];
  };
  std::printf("%s: residuals median %.3f px, 90 %% %.3f, 99 %% %.3f\n", what, at(0.5), at(0.9), at(0.99));
}

/// The first views of a bundle, with what is known then of the points: the start of each is the prior of new landmarks.
Bundle prefix_of(const Bundle& all, int views) {
  Bundle out;
  out.views.assign(all.views.begin(), all.views.begin() + views);
  out.first_view = all.first_view;
  out.first_view_cov = all.first_view_cov;
  std::vector<int> count(all.points.size());
  for (const BundleObservation& o : all.observations)
    count[static_cast<std::size_t>(o.point)] += o.view < views;
  std::vector<int> index(all.points.size(), -1);
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    if (count[i] < 2) continue;
    index[i] = static_cast<int>(out.points.size());
    out.points.push_back(all.points[i]);
  }
  for (const BundleObservation& o : all.observations) {
    const int point = index[static_cast<std::size_t>(o.point)];
    if (o.view >= views || point < 0) continue;
    out.observations.push_back(o);
    out.observations.back().point = point;
  }
  return out;
}

/// Each view as the adjustment of the views up to it has it.
Trajectory causal(const Bundle& all, const Camera& camera, const AdjustmentSettings& settings,
                  const Trajectory& estimate, double inverse_depth_per_m) {
  Bundle state = all;
  for (BundlePoint& point : state.points)
    if (point.kind == BundlePoint::Kind::inverse_depth)
      point.prior_inverse_depth = point.sigma_prior_inverse_depth = point.value[2] = inverse_depth_per_m;
  Trajectory out = estimate;
  BundleEquations equations;
  for (int n = 2; n <= static_cast<int>(all.views.size()); ++n) {
    const auto k = static_cast<std::size_t>(n - 1);
    state.views[k] = state.views[k - 1];
    Bundle prefix = prefix_of(state, n);
    const AdjustmentReport report = adjust(prefix, camera, settings, equations);
    if (report.outcome == AdjustmentReport::Outcome::refused) std::printf("view %zu refused\n", k);
    std::ranges::copy(prefix.views, state.views.begin());
    std::vector<int> count(state.points.size());
    for (const BundleObservation& o : all.observations)
      count[static_cast<std::size_t>(o.point)] += o.view < n;
    std::size_t next = 0;
    for (std::size_t i = 0; i < state.points.size(); ++i)
      if (count[i] >= 2) state.points[i] = prefix.points[next++];
    out[k].position = state.views[k].position;
    out[k].orientation = state.views[k].world_from_camera;
  }
  return out;
}

int adjust_run(const Wanted& wanted) {
  std::optional<Camera> seen_by;
  const Recorded run = incognita::run(wanted, seen_by);
  const Camera& camera = *seen_by;
  if (run.matches.views.size() < 2) {
    std::cerr << "no frames were tracked\n";
    return 1;
  }
  Bundle bundle = bundle_of(run.matches, camera, 0.3);
  std::printf("%zu views, %zu points, %zu measurements, %d frames lost\n", bundle.views.size(),
              bundle.points.size(), bundle.observations.size(), run.lost);
  print_residuals("filter", bundle, camera);
  BundleEquations equations;
  AdjustmentSettings settings;
  settings.max_iterations = 100;
  settings.min_relative_decrease = 1e-6;
  const AdjustmentReport report = adjust(bundle, camera, settings, equations);
  print_residuals("adjusted", bundle, camera);
  std::printf("cost %.1f -> %.1f in %d steps%s\n", report.first_cost, report.last_cost, report.iterations,
              report.outcome == AdjustmentReport::Outcome::refused ? ", REFUSED" : "");
  Trajectory adjusted = run.estimate;
  for (std::size_t i = 0; i < adjusted.size(); ++i) {
    adjusted[i].position = bundle.views[i].position;
    adjusted[i].orientation = bundle.views[i].world_from_camera;
  }
  std::printf("ATE (Sim3): filter %.4f m, adjusted %.4f m; between them %.4f m\n",
              ate(run.estimate, run.truth, AlignmentKind::sim3),
              ate(adjusted, run.truth, AlignmentKind::sim3),
              ate(run.estimate, adjusted, AlignmentKind::sim3));
  if (wanted.causal) {
    settings.max_iterations = 20;
    settings.min_relative_decrease = 1e-4;
    const Trajectory at_once = causal(bundle, camera, settings, run.estimate, 0.5);
    std::printf("ATE (Sim3) of each view at its time: %.4f m\n",
                ate(at_once, run.truth, AlignmentKind::sim3));
  }
  if (wanted.out.empty()) return 0;
  std::ofstream file(wanted.out);
  for (const StampedPose& pose : adjusted)
    file << pose.t << ' ' << pose.position.transpose() << ' ' << pose.orientation.tail<3>().transpose() << ' '
         << pose.orientation[0] << '\n';
  return file ? 0 : 1;
}

}  // namespace
}  // namespace incognita

int main(int argc, char** argv) { return incognita::adjust_run(incognita::wanted_by(argc, argv)); }
