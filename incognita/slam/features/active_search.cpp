#include "incognita/slam/features/active_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/features/consensus.hpp"
#include "incognita/slam/features/map_management.hpp"
#include "incognita/slam/features/predict_matches.hpp"

namespace incognita {
namespace {

/// Frames without a match after which a matched landmark counts as re-observed. A new landmark is matched in
/// every frame and is the only source of information about its depth.
constexpr int frames_until_away = 15;

/// Two matches nearer than this are of the same corner: patches are wider, so that new landmarks begin farther apart.
constexpr double same_corner_px = 3;

/// A corner that was mapped again, while its first feature was seen too obliquely or too near to be searched for, would
/// count its information twice. The anchor remains, or the older landmark.
void drop_repeated_corners(TrackedCamera& camera) {
  const auto is_behind = [](const FeatureMatch& a, const FeatureMatch& b) {
    return a.anchor != b.anchor ? b.anchor : a.id > b.id;
  };
  for (FeatureMatch& match : camera.matches) {
    if (match.outcome != MatchOutcome::matched) continue;
    const bool is_repeated = std::ranges::any_of(camera.matches, [&](const FeatureMatch& other) {
      return other.outcome == MatchOutcome::matched && is_behind(match, other) &&
             (*match.measured - *other.measured).norm() < same_corner_px;
    });
    if (!is_repeated) continue;
    match.outcome = MatchOutcome::not_searched;
    match.measured.reset();
    --camera.predicted;
  }
}

/// Information about camera and map that a match gives, 1/2 log |S R^-1| (thesis C.2), times the probability of one.
double expected_information(const FeatureMatch& match, const TrackedCamera& camera) {
  const double ratio = match.innovation_cov.determinant() / (camera.pixel_var() * camera.pixel_var());
  return 0.5 * std::log(ratio) * match_probability(camera.features.at(match.id));
}

}  // namespace

void active_search(const SummedImage& image, TrackedCamera& camera) {
  const SearchSettings& settings = camera.settings.search;
  for (FeatureMatch& match : camera.matches) match.expected_information = expected_information(match, camera);
  std::sort(camera.matches.begin(), camera.matches.end(), [](const FeatureMatch& a, const FeatureMatch& b) {
    return a.expected_information != b.expected_information ? a.expected_information > b.expected_information
                                                            : a.id < b.id;
  });
  thread_local CorrelationSheet sheet;
  camera.predicted = 0;
  for (FeatureMatch& match : camera.matches) {
    if (camera.predicted == settings.max_measurements) break;
    const auto patch =
        warp(camera.features.at(match.id).view.texture, match.texture_from_view, settings.patch_size_px);
    if (!patch) continue;
    ++camera.predicted;
    match.outcome = MatchOutcome::not_found;
    const auto found =
        search(sheet, image, *patch, {match.predicted, match.innovation_cov, settings.gate_sigmas},
               settings.max_half_axis_px);
    if (!found) continue;
    match.correlation = found->correlation;
    if (found->correlation < settings.min_correlation) continue;
    match.measured = found->pixel;
    match.outcome = MatchOutcome::matched;
  }
  drop_repeated_corners(camera);
}

void reject_outliers(const Estimate& estimate, TrackedCamera& camera) {
  camera.matched = 0;
  std::vector<LinearizedMeasurement> measurements;
  std::vector<FeatureMatch*> matched;
  std::vector<bool> returning;
  for (FeatureMatch& match : camera.matches) {
    if (match.outcome != MatchOutcome::matched) continue;
    matched.push_back(&match);
    measurements.push_back(linearized_measurement(match, estimate.landmarks.at(match.id), camera));
    returning.push_back(camera.features.at(match.id).frames_away >= frames_until_away);
  }
  if (matched.empty()) return;
  Eigen::MatrixXd S;
  estimate.belief.innovation_covariance(measurements, S);
  Eigen::VectorXd residuals(S.rows());
  for (std::size_t i = 0; i < matched.size(); ++i)
    residuals.segment<2>(2 * static_cast<Eigen::Index>(i)) = measurements[i].residual;
  const SearchSettings& settings = camera.settings.search;
  const double gate = chi_square_quantile(settings.gate_probability, 2);
  const std::vector<bool> agrees = consistent_matches(residuals, S, gate);
  const std::vector<bool> unconfirmed =
      unconfirmed_matches(S, agrees, returning, settings.max_unconfirmed_sigma_px);
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (!agrees[i]) matched[i]->outcome = MatchOutcome::outlier;
    if (unconfirmed[i]) matched[i]->outcome = MatchOutcome::unconfirmed;
    camera.matched += matched[i]->outcome == MatchOutcome::matched;
  }
}

}  // namespace incognita
