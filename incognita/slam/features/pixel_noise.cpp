#include "incognita/slam/features/pixel_noise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "incognita/math/median.hpp"
#include "incognita/slam/features/predict_matches.hpp"

namespace incognita {
namespace {

constexpr std::size_t least_matches = 8;
constexpr double frames_averaged = 30;
constexpr double least_px = 0.25, most_px = 2;  // with a larger one hardly any match is refused
constexpr double gate_sigmas = 3;
constexpr double most_correlation = 0.95;
constexpr double pose_errors = 6;  // numbers that each frame fits to its matches

}  // namespace

void PixelNoise::update(const Estimate& estimate, TrackedCamera& camera) {
  squares_.clear();
  now_.clear();
  for (const FeatureMatch& match : camera.matches) {
    if (match.outcome != MatchOutcome::matched || match.level > 0) continue;
    const auto corrected = predict_pixel(estimate.landmarks.at(match.id), estimate.belief, camera.camera,
                                         camera.view.camera, camera.settings);
    if (!corrected) continue;
    now_.push_back({match.id, *match.measured - corrected->predicted});
    squares_.push_back(now_.back().px.squaredNorm());
  }
  if (squares_.size() < least_matches) return;
  // The median of a chi-squared variable with 2 degrees of freedom is 2 ln 2
  const double residual_var = median(squares_) / (2 * std::numbers::ln2);
  const double rows = 2 * static_cast<double>(squares_.size());
  const double now = residual_var * rows / (rows - pose_errors);
  const double var = camera.pixel_var() + (now - camera.pixel_var()) / frames_averaged;
  camera.sigma_pixel_px = std::clamp(std::sqrt(var), least_px, most_px);
  update_lasting(camera);
}

void PixelNoise::update_lasting(TrackedCamera& camera) {
  std::ranges::sort(now_, {}, &Residual::id);
  double product = 0, square = 0;
  int pairs = 0;
  const double gate = std::pow(gate_sigmas, 2) * camera.pixel_var();
  for (const Residual& now : now_) {
    const auto before = std::ranges::lower_bound(before_, now.id, {}, &Residual::id);
    if (before == before_.end() || before->id != now.id) continue;
    if (now.px.squaredNorm() > gate || before->px.squaredNorm() > gate) continue;
    product += now.px.dot(before->px);
    square += 0.5 * (now.px.squaredNorm() + before->px.squaredNorm());
    ++pairs;
  }
  std::swap(before_, now_);
  if (pairs < static_cast<int>(least_matches)) return;
  product_ += (product / pairs - product_) / frames_averaged;
  square_ += (square / pairs - square_) / frames_averaged;
  const double r = std::clamp(product_ / std::max(square_, 1e-6), 0.0, most_correlation);
  camera.lasting_factor = (1 + r) / (1 - r);
}

}  // namespace incognita
