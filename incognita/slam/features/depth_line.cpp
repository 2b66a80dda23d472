#include "incognita/slam/features/depth_line.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "incognita/slam/features/predict_matches.hpp"

namespace incognita {
namespace {

constexpr double prune_below = 0.05;  // of the uniform weight; hypotheses below are removed

struct Hypothesis {
  std::size_t particle;
  Ellipse ellipse;
};

InverseDepthLandmark::State line_at(const Landmark& line, const Belief& belief, double inverse_depth) {
  InverseDepthLandmark::State y;
  y << belief.mean(line.block), inverse_depth;
  return y;
}

/// The predicted pixel of each hypothesis with its innovation ellipse.
std::vector<Hypothesis> project(const Landmark& line, const Estimate& estimate, const Camera& camera,
                                const CameraSlamSettings& settings) {
  std::vector<Hypothesis> predictions;
  const CameraState from = estimate.camera_state();
  const double pixel_var = std::pow(settings.filter.sigma_pixel_px, 2);
  Eigen::MatrixXd S(2, 2);
  for (std::size_t i = 0; i < line.particles.size(); ++i) {
    const auto prediction = line.initial_axes.predict_measurement(
        camera, from, line_at(line, estimate.belief, line.particles[i].inverse_depth));
    if (!prediction || !camera.contains(prediction->pixel, settings.search.patch_size_px / 2 + 1)) continue;
    LinearizedMeasurement affine;
    affine.add(estimate.camera, prediction->Hv);
    affine.add(line.block, prediction->Hl.leftCols<5>());
    affine.residual = Eigen::Vector2d::Zero();
    affine.R = pixel_var * Eigen::Matrix2d::Identity();
    estimate.belief.innovation_covariance({&affine, 1}, S);
    predictions.push_back({i, {prediction->pixel, S, settings.search.gate_sigmas}});
  }
  return predictions;
}

/// The best match in the union of all ellipses; overlapping ellipses share the correlations of one sheet.
std::optional<Found> search_union(CorrelationSheet& sheet, const std::vector<Hypothesis>& hypotheses,
                                  const SearchSettings& settings) {
  std::optional<Found> best;
  for (const Hypothesis& hypothesis : hypotheses) {
    const auto found = search(sheet, hypothesis.ellipse, settings.max_half_axis_px);
    if (found && (!best || found->correlation > best->correlation)) best = found;
  }
  return best;
}

void start_sheet(CorrelationSheet& sheet, const SummedImage& image, const PatchTemplate& patch,
                 const std::vector<Hypothesis>& hypotheses, const SearchSettings& settings) {
  Eigen::Array2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const Hypothesis& h : hypotheses) {
    const Eigen::Array2d half = (settings.gate_sigmas * h.ellipse.covariance.diagonal().array().sqrt())
                                    .min(settings.max_half_axis_px);
    low = low.min(h.ellipse.center.array() - half);
    high = high.max(h.ellipse.center.array() + half);
  }
  sheet.start(image, patch, static_cast<int>(low.x()) - 1, static_cast<int>(high.x()) + 2,
              static_cast<int>(low.y()) - 1, static_cast<int>(high.y()) + 2);
}

/// Bayes update of the weights by the likelihood of the match; hypotheses out of view are removed.
/// False when no hypothesis explains the match.
bool reweight(Landmark& line, const std::vector<Hypothesis>& hypotheses, const Eigen::Vector2d& found) {
  std::vector<Landmark::Particle> kept;
  double total = 0;
  for (const Hypothesis& h : hypotheses) {
    const Eigen::Vector2d r = found - h.ellipse.center;
    const double distance = r.dot(h.ellipse.covariance.inverse() * r);
    const double likelihood =
        std::exp(-0.5 * distance) / (2 * std::numbers::pi * std::sqrt(h.ellipse.covariance.determinant()));
    kept.push_back(
        {line.particles[h.particle].inverse_depth, line.particles[h.particle].weight * likelihood});
    total += kept.back().weight;
  }
  if (!(total > 1e-12)) return false;
  const double least = prune_below * total / static_cast<double>(kept.size());
  std::erase_if(kept, [&](const Landmark::Particle& p) { return p.weight < least; });
  total = 0;
  for (const auto& particle : kept) total += particle.weight;
  for (auto& particle : kept) particle.weight /= total;
  line.particles = std::move(kept);
  return true;
}

struct Depth {
  double mean, sigma;
};

Depth depth_of(const Landmark& line) {
  double mean = 0, square = 0;
  for (const auto& p : line.particles) {
    mean += p.weight / p.inverse_depth;
    square += p.weight / (p.inverse_depth * p.inverse_depth);
  }
  return {mean, std::sqrt(std::max(0.0, square - mean * mean))};
}

/// Converts the line to a point with the Gaussian of its hypotheses; the quantization of their spacing is added.
void become_point(Landmark& line, Belief& belief, const Depth& depth, double spacing_m) {
  const auto y = line_at(line, belief, 1 / depth.mean);
  const auto point = line.initial_axes.point(y);
  const Eigen::Vector3d along = (point.position - y.head<3>()) / depth.mean;
  const double sigma = std::hypot(depth.sigma, spacing_m / std::sqrt(12.0));
  belief.replace(line.block, PointLandmark::chart, point.position, point.J.leftCols<5>(),
                 sigma * sigma * along * along.transpose());
  line.kind = Landmark::Kind::point;
  line.particles.clear();
}

/// The mixture of the hypotheses as one Gaussian, for display.
LineMatch predict_line_match(const Landmark& line, const std::vector<Hypothesis>& hypotheses) {
  LineMatch match;
  match.id = line.id;
  double total = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  const Eigen::Vector2d origin = hypotheses.front().ellipse.center;
  for (const Hypothesis& h : hypotheses) {
    const double weight = line.particles[h.particle].weight;
    const Eigen::Vector2d at = h.ellipse.center - origin;
    total += weight;
    sum += weight * at;
    square += weight * (h.ellipse.covariance + at * at.transpose());
  }
  const Eigen::Vector2d mean = sum / total;
  match.predicted = origin + mean;
  match.innovation_cov = square / total - mean * mean.transpose();
  return match;
}

/// Tracks one line in one image. False when the line is to be dropped.
bool follow(Landmark& line, CorrelationSheet& sheet, const SummedImage& image, Estimate& estimate,
            const Camera& camera, const CameraSlamSettings& settings) {
  const auto hypotheses = project(line, estimate, camera, settings);
  const auto fail = [&] { return ++line.line_failures < settings.initialization.max_line_failures; };
  if (hypotheses.empty()) return fail();
  LineMatch& match = estimate.line_matches.emplace_back(predict_line_match(line, hypotheses));
  const Depth before = depth_of(line);
  const CameraState from = estimate.camera_state();
  const Eigen::Vector3d at =
      line.initial_axes.point(line_at(line, estimate.belief, 1 / before.mean)).position;
  const auto middle = camera.project(PointLandmark::in_camera<double>(from, at));
  if (!middle) return fail();
  const auto warping = local_warp(line.view, line.view.plane.normal(), at, middle->pixel, camera, from);
  if (!warping) return fail();
  const auto patch = warp(line.view.texture, *warping, settings.search.patch_size_px);
  if (!patch) return fail();
  start_sheet(sheet, image, *patch, hypotheses, settings.search);
  const auto found = search_union(sheet, hypotheses, settings.search);
  match.outcome = MatchOutcome::not_found;
  if (!found) return fail();
  match.correlation = found->correlation;
  if (found->correlation < settings.search.min_correlation) return fail();
  line.line_failures = 0;
  match.measured = found->pixel;
  match.outcome = MatchOutcome::outlier;
  if (!reweight(line, hypotheses, found->pixel)) return false;
  match.outcome = MatchOutcome::matched;
  const Depth depth = depth_of(line);
  if (depth.sigma < settings.initialization.depth_ratio * depth.mean)
    become_point(line, estimate.belief, depth,
                 (settings.initialization.max_depth_m - settings.initialization.min_depth_m) /
                     settings.initialization.particles);
  return true;
}

}  // namespace

void update_depth_lines(const SummedImage& image, Estimate& estimate, const Camera& camera,
                        const CameraSlamSettings& settings) {
  CorrelationSheet sheet;
  std::erase_if(estimate.catalog, [&](Landmark& landmark) {
    if (landmark.kind != Landmark::Kind::line) return false;
    if (follow(landmark, sheet, image, estimate, camera, settings)) return false;
    estimate.belief.drop(landmark.block);
    return true;
  });
}

}  // namespace incognita
