#include "incognita/slam/mapper/depth_hypotheses.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "incognita/slam/mapper/landmarks.hpp"

namespace incognita {

std::vector<DepthHypothesis> uniform_depths(const DepthRange& range, double ray_length) {
  std::vector<DepthHypothesis> depths;
  for (int i = 0; i < range.count; ++i) {
    const double share = range.count > 1 ? static_cast<double>(i) / (range.count - 1) : 0.5;
    const double depth = range.min_m + share * (range.max_m - range.min_m);
    depths.push_back({ray_length / depth, 1.0 / range.count});
  }
  return depths;
}

RayDepth depth_of(const std::vector<DepthHypothesis>& hypotheses) {
  double mean = 0, square = 0;
  for (const DepthHypothesis& h : hypotheses) {
    mean += h.weight / h.inverse_depth;
    square += h.weight / (h.inverse_depth * h.inverse_depth);
  }
  return {mean, std::sqrt(std::max(0.0, square - mean * mean))};
}

std::optional<RayDepth> converged_depth(const std::vector<DepthHypothesis>& hypotheses, double ratio) {
  const RayDepth depth = depth_of(hypotheses);
  return depth.sigma < ratio * depth.mean ? std::optional(depth) : std::nullopt;
}

InverseDepthLandmark::State ray_at(const Landmark& ray, const AnyBelief& belief, double inverse_depth) {
  InverseDepthLandmark::State y;
  y << belief.mean(ray.block), inverse_depth;
  return y;
}

double PredictedHypothesis::distance2(const Eigen::Vector2d& found) const {
  const Eigen::Vector2d r = found - pixel;
  return r.dot(innovation_cov.inverse() * r);
}

PredictedRay predicted_ray(const std::vector<DepthHypothesis>& depths,
                           std::span<const PredictedHypothesis> predicted) {
  double total = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  const Eigen::Vector2d origin = predicted.front().pixel;
  for (const PredictedHypothesis& h : predicted) {
    const double weight = depths[h.depth].weight;
    const Eigen::Vector2d at = h.pixel - origin;
    total += weight;
    sum += weight * at;
    square += weight * (h.innovation_cov + at * at.transpose());
  }
  const Eigen::Vector2d mean = sum / total;
  return {origin + mean, square / total - mean * mean.transpose()};
}

void append_particles(const std::vector<DepthHypothesis>& depths,
                      std::span<const PredictedHypothesis> predicted, std::vector<DepthParticle>& particles) {
  for (const PredictedHypothesis& h : predicted) particles.push_back({h.pixel, depths[h.depth].weight});
}

bool reweight(std::vector<DepthHypothesis>& depths, std::span<const PredictedHypothesis> predicted,
              const Eigen::Vector2d& found) {
  constexpr double prune_below = 0.05;  // of the mean weight
  std::vector<DepthHypothesis> kept;
  double total = 0;
  for (const PredictedHypothesis& h : predicted) {
    const double likelihood = std::exp(-0.5 * h.distance2(found)) /
                              (2 * std::numbers::pi * std::sqrt(h.innovation_cov.determinant()));
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

void convert_to_point(AnyBelief& belief, Landmark& ray, const RayDepth& depth, double spacing_m) {
  const InverseDepthLandmark::State y = ray_at(ray, belief, 1 / depth.mean);
  const auto point = InverseDepthLandmark{ray.form.initial_axes}.point(y);
  const Eigen::Vector3d along = (point.position - y.head<3>()) / depth.mean;
  const double sigma = std::hypot(depth.sigma, spacing_m / std::sqrt(12.0));
  convert_to_point(belief, ray, point.position, point.J.leftCols<5>(),
                   sigma * sigma * along * along.transpose());
}

}  // namespace incognita
