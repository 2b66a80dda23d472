#include "incognita/slam/features/depth_line.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "incognita/slam/features/each_feature.hpp"
#include "incognita/slam/features/map_management.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/slam/mapper/landmarks.hpp"

namespace incognita {
namespace {

using Hypotheses = std::vector<PredictedHypothesis>;

InverseDepthLandmark axes_of(const Landmark& line) { return InverseDepthLandmark{line.form.initial_axes}; }

Ellipse gate_of(const PredictedHypothesis& h, const SearchSettings& settings) {
  return {h.pixel, h.innovation_cov, settings.gate_sigmas};
}

/// The predicted pixel of each hypothesis with its innovation ellipse.
Hypotheses project(const Landmark& line, const Feature& feature, const Estimate& estimate,
                   const TrackedCamera& camera) {
  Hypotheses predictions;
  const SearchSettings& search = camera.settings.search;
  Eigen::MatrixXd S(2, 2);
  for (std::size_t i = 0; i < feature.depths.size(); ++i) {
    const auto prediction = axes_of(line).predict_measurement(
        camera.camera, camera.view.camera, ray_at(line, estimate.belief, feature.depths[i].inverse_depth));
    if (!prediction || !camera.camera.contains(prediction->pixel, search.patch_size_px / 2 + 1)) continue;
    LinearizedMeasurement measurement;
    measurement.add(camera.view.body, camera.view.jacobian(prediction->Hv));
    measurement.add(line.block, prediction->Hl.leftCols<5>());
    measurement.residual = Eigen::Vector2d::Zero();
    measurement.R = camera.error_var() * Eigen::Matrix2d::Identity();
    estimate.belief.innovation_covariance({&measurement, 1}, S);
    predictions.push_back({i, prediction->pixel, S});
  }
  return predictions;
}

/// The best match in the union of all gates; overlapping gates share the correlations of one sheet.
std::optional<Found> search_union(CorrelationSheet& sheet, const Hypotheses& hypotheses,
                                  const SearchSettings& settings) {
  std::optional<Found> best;
  for (const PredictedHypothesis& h : hypotheses) {
    const auto found = search(sheet, with_nearest_pixels(gate_of(h, settings)), settings.max_half_axis_px);
    if (found && (!best || found->correlation > best->correlation)) best = found;
  }
  return best;
}

void start_sheet(CorrelationSheet& sheet, const SummedImage& image, const PatchTemplate& patch,
                 const Hypotheses& hypotheses, const SearchSettings& settings) {
  Eigen::Array2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const PredictedHypothesis& h : hypotheses) {
    const Ellipse searched = with_nearest_pixels(gate_of(h, settings));
    const Eigen::Array2d half =
        (searched.gate_sigmas * searched.covariance.diagonal().array().sqrt()).min(settings.max_half_axis_px);
    low = low.min(searched.center.array() - half);
    high = high.max(searched.center.array() + half);
  }
  sheet.start(image, patch, static_cast<int>(low.x()) - 1, static_cast<int>(high.x()) + 2,
              static_cast<int>(low.y()) - 1, static_cast<int>(high.y()) + 2);
}

/// Whether the match lies in the gate of a hypothesis. Beyond the pixels nearest to a gate, which are searched too, it is false.
bool is_in_gate(const Hypotheses& hypotheses, const Eigen::Vector2d& found, double gate_sigmas) {
  return std::ranges::any_of(hypotheses, [&](const PredictedHypothesis& h) {
    return h.distance2(found) <= gate_sigmas * gate_sigmas;
  });
}

RayMatch predict_ray_match(std::int64_t id, const Feature& feature, const Hypotheses& hypotheses) {
  const PredictedRay predicted = predicted_ray(feature.depths, hypotheses);
  RayMatch match;
  match.id = id;
  match.predicted = predicted.pixel;
  match.innovation_cov = predicted.innovation_cov;
  return match;
}

/// Keeps the hypotheses in view as they are before the match, for display.
void keep_particles(RayMatch& match, const Feature& feature, const Hypotheses& hypotheses,
                    std::vector<DepthParticle>& particles) {
  match.first_particle = static_cast<int>(particles.size());
  match.particle_count = static_cast<int>(hypotheses.size());
  append_particles(feature.depths, hypotheses, particles);
}

/// The patch of a line as it looks from here, at its mean depth.
std::optional<PatchTemplate> patch_of(const Landmark& line, const Feature& feature, const Estimate& estimate,
                                      const TrackedCamera& camera) {
  const CameraState& from = camera.view.camera;
  const Eigen::Vector3d at = *current_position(estimate, line, feature);
  const auto middle = camera.camera.project(PointLandmark::in_camera<double>(from, at));
  if (!middle) return std::nullopt;
  const auto warping =
      local_warp(feature.view, feature.view.plane.normal(), at, middle->pixel, camera.camera, from);
  if (!warping) return std::nullopt;
  return warp(feature.view.texture, *warping, camera.settings.search.patch_size_px);
}

/// Tracks one line in one image. False when the line is to be dropped.
bool follow(Landmark& line, Feature& feature, CorrelationSheet& sheet, const SummedImage& image,
            Estimate& estimate, TrackedCamera& camera) {
  const InitializationSettings& initialization = camera.settings.initialization;
  const auto hypotheses = project(line, feature, estimate, camera);
  const auto fail = [&] { return ++feature.ray_failures < initialization.max_line_failures; };
  if (hypotheses.empty()) return fail();
  RayMatch& match = camera.ray_matches.emplace_back(predict_ray_match(line.id, feature, hypotheses));
  keep_particles(match, feature, hypotheses, camera.ray_particles);
  const auto patch = patch_of(line, feature, estimate, camera);
  if (!patch) return fail();
  start_sheet(sheet, image, *patch, hypotheses, camera.settings.search);
  const auto found = search_union(sheet, hypotheses, camera.settings.search);
  match.outcome = MatchOutcome::not_found;
  if (!found) return fail();
  match.correlation = found->correlation;
  if (found->correlation < camera.settings.search.min_correlation) return fail();
  match.measured = found->pixel;
  match.outcome = MatchOutcome::outlier;
  if (!is_in_gate(hypotheses, found->pixel, camera.settings.search.gate_sigmas)) return fail();
  feature.ray_failures = 0;
  if (!reweight(feature.depths, hypotheses, found->pixel)) return false;
  match.outcome = MatchOutcome::matched;
  if (const auto depth = converged_depth(feature.depths, initialization.depth_ratio)) {
    convert_to_point(estimate.belief, line, *depth, initialization.depth_range().spacing_m());
    feature.depths.clear();
  }
  return true;
}

}  // namespace

void update_depth_lines(const SummedImage& image, Estimate& estimate, TrackedCamera& camera) {
  CorrelationSheet sheet;
  for_each_feature(estimate, camera.features, [&](Landmark& landmark, Feature& feature) {
    if (landmark.form.kind != LandmarkParametrization::Kind::ray) return;
    if (!follow(landmark, feature, sheet, image, estimate, camera))
      remove_landmark(estimate, camera, landmark.id);
  });
}

void drop_depth_lines(Estimate& estimate, TrackedCamera& camera) {
  for_each_feature(estimate, camera.features, [&](const Landmark& landmark, const Feature&) {
    if (landmark.form.kind == LandmarkParametrization::Kind::ray)
      remove_landmark(estimate, camera, landmark.id);
  });
}

}  // namespace incognita
