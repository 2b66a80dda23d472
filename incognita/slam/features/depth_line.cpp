#include "incognita/slam/features/depth_line.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "incognita/slam/features/each_feature.hpp"
#include "incognita/slam/features/map_management.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/slam/mapper/landmarks.hpp"

namespace incognita {
namespace {

constexpr double prune_below = 0.05;  // of the uniform weight; hypotheses below are removed

struct Hypothesis {
  std::size_t depth;  // index of the feature's depths
  Ellipse gate;
};

InverseDepthLandmark axes_of(const Landmark& line) { return InverseDepthLandmark{line.form.initial_axes}; }

InverseDepthLandmark::State line_at(const Landmark& line, const AnyBelief& belief, double inverse_depth) {
  InverseDepthLandmark::State y;
  y << belief.mean(line.block), inverse_depth;
  return y;
}

/// The predicted pixel of each hypothesis with its innovation ellipse.
std::vector<Hypothesis> project(const Landmark& line, const Feature& feature, const Estimate& estimate,
                                const TrackedCamera& camera) {
  std::vector<Hypothesis> predictions;
  const SearchSettings& search = camera.settings.search;
  Eigen::MatrixXd S(2, 2);
  for (std::size_t i = 0; i < feature.depths.size(); ++i) {
    const auto prediction = axes_of(line).predict_measurement(
        camera.camera, camera.view.camera, line_at(line, estimate.belief, feature.depths[i].inverse_depth));
    if (!prediction || !camera.camera.contains(prediction->pixel, search.patch_size_px / 2 + 1)) continue;
    LinearizedMeasurement measurement;
    measurement.add(camera.view.body, camera.view.jacobian(prediction->Hv));
    measurement.add(line.block, prediction->Hl.leftCols<5>());
    measurement.residual = Eigen::Vector2d::Zero();
    measurement.R = camera.error_var() * Eigen::Matrix2d::Identity();
    estimate.belief.innovation_covariance({&measurement, 1}, S);
    predictions.push_back({i, {prediction->pixel, S, search.gate_sigmas}});
  }
  return predictions;
}

/// The best match in the union of all gates; overlapping gates share the correlations of one sheet.
std::optional<Found> search_union(CorrelationSheet& sheet, const std::vector<Hypothesis>& hypotheses,
                                  const SearchSettings& settings) {
  std::optional<Found> best;
  for (const Hypothesis& hypothesis : hypotheses) {
    const auto found = search(sheet, with_nearest_pixels(hypothesis.gate), settings.max_half_axis_px);
    if (found && (!best || found->correlation > best->correlation)) best = found;
  }
  return best;
}

void start_sheet(CorrelationSheet& sheet, const SummedImage& image, const PatchTemplate& patch,
                 const std::vector<Hypothesis>& hypotheses, const SearchSettings& settings) {
  Eigen::Array2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const Hypothesis& h : hypotheses) {
    const Ellipse searched = with_nearest_pixels(h.gate);
    const Eigen::Array2d half =
        (searched.gate_sigmas * searched.covariance.diagonal().array().sqrt()).min(settings.max_half_axis_px);
    low = low.min(searched.center.array() - half);
    high = high.max(searched.center.array() + half);
  }
  sheet.start(image, patch, static_cast<int>(low.x()) - 1, static_cast<int>(high.x()) + 2,
              static_cast<int>(low.y()) - 1, static_cast<int>(high.y()) + 2);
}

/// Whether the match lies in the gate of a hypothesis. Beyond the pixels nearest to a gate, which are searched too, it is false.
bool is_in_gate(const std::vector<Hypothesis>& hypotheses, const Eigen::Vector2d& found) {
  return std::ranges::any_of(hypotheses, [&](const Hypothesis& h) {
    const Eigen::Vector2d r = found - h.gate.center;
    return r.dot(h.gate.covariance.inverse() * r) <= h.gate.gate_sigmas * h.gate.gate_sigmas;
  });
}

/// Bayes update of the weights by the likelihood of the match; hypotheses out of view are removed.
/// False when no hypothesis explains the match.
bool reweight(std::vector<DepthHypothesis>& depths, const std::vector<Hypothesis>& hypotheses,
              const Eigen::Vector2d& found) {
  std::vector<DepthHypothesis> kept;
  double total = 0;
  for (const Hypothesis& h : hypotheses) {
    const Eigen::Vector2d r = found - h.gate.center;
    const double distance = r.dot(h.gate.covariance.inverse() * r);
    const double likelihood =
        std::exp(-0.5 * distance) / (2 * std::numbers::pi * std::sqrt(h.gate.covariance.determinant()));
    kept.push_back({depths[h.depth].inverse_depth, depths[h.depth].weight * likelihood});
    total += kept.back().weight;
  }
  if (!(total > 1e-12)) return false;
  const double least = prune_below * total / static_cast<double>(kept.size());
  std::erase_if(kept, [&](const DepthHypothesis& h) { return h.weight < least; });
  total = 0;
  for (const auto& h : kept) total += h.weight;
  for (auto& h : kept) h.weight /= total;
  depths = std::move(kept);
  return true;
}

/// Converts the line to a point with the Gaussian of its hypotheses; the quantization of their spacing is added.
void become_point(Landmark& line, Feature& feature, AnyBelief& belief, const RayDepth& depth,
                  double spacing_m) {
  const auto y = line_at(line, belief, 1 / depth.mean);
  const auto point = axes_of(line).point(y);
  const Eigen::Vector3d along = (point.position - y.head<3>()) / depth.mean;
  const double sigma = std::hypot(depth.sigma, spacing_m / std::sqrt(12.0));
  convert_to_point(belief, line, point.position, point.J.leftCols<5>(),
                   sigma * sigma * along * along.transpose());
  feature.depths.clear();
}

/// The mixture of the hypotheses as one Gaussian, for display.
RayMatch predict_ray_match(std::int64_t id, const Feature& feature,
                           const std::vector<Hypothesis>& hypotheses) {
  RayMatch match;
  match.id = id;
  double total = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  const Eigen::Vector2d origin = hypotheses.front().gate.center;
  for (const Hypothesis& h : hypotheses) {
    const double weight = feature.depths[h.depth].weight;
    const Eigen::Vector2d at = h.gate.center - origin;
    total += weight;
    sum += weight * at;
    square += weight * (h.gate.covariance + at * at.transpose());
  }
  const Eigen::Vector2d mean = sum / total;
  match.predicted = origin + mean;
  match.innovation_cov = square / total - mean * mean.transpose();
  return match;
}

/// Keeps the hypotheses in view as they are before the match, for display.
void keep_particles(RayMatch& match, const Feature& feature, const std::vector<Hypothesis>& hypotheses,
                    std::vector<DepthParticle>& particles) {
  match.first_particle = static_cast<int>(particles.size());
  match.particle_count = static_cast<int>(hypotheses.size());
  for (const Hypothesis& h : hypotheses) particles.push_back({h.gate.center, feature.depths[h.depth].weight});
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
  if (!is_in_gate(hypotheses, found->pixel)) return fail();
  feature.ray_failures = 0;
  if (!reweight(feature.depths, hypotheses, found->pixel)) return false;
  match.outcome = MatchOutcome::matched;
  const RayDepth depth = depth_of(feature.depths);
  if (depth.sigma < initialization.depth_ratio * depth.mean)
    become_point(line, feature, estimate.belief, depth,
                 (initialization.max_depth_m - initialization.min_depth_m) / initialization.particles);
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
