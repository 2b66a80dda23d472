#include "incognita/slam/features/active_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/features/consensus.hpp"
#include "incognita/slam/features/map_management.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/slam/features/search_feature.hpp"
#include "incognita/vision/corners.hpp"

namespace incognita {
namespace {

/// Frames without a match after which a matched landmark counts as re-observed. A new landmark is matched in
/// every frame and is the only source of information about its depth.
constexpr int frames_until_away = 15;

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
  const double ratio = match.innovation_cov.determinant() / match.error_cov.determinant();
  return 0.5 * std::log(ratio) * match_probability(camera.features.at(match.id));
}

/// An anchor that is hidden waits its turn.
bool is_probable(const FeatureMatch& match, const TrackedCamera& camera) {
  return match_probability(camera.features.at(match.id)) > 0.5;
}

}  // namespace

namespace {

/// In a blurred image hardly any patch matches at full resolution. They are searched for again at half of it, where blur is
/// half as wide; positions are then less precise.
constexpr double blurred_share =
    0.5;  // of the searches that succeeded, below which the image counts as blurred
constexpr int blurred_level = 1;

void accept(FeatureMatch& match, const std::optional<Found>& found, double min_correlation, int level) {
  if (!found) return;
  match.correlation = found->correlation;
  if (found->correlation < min_correlation) return;
  match.measured = found->pixel;
  match.level = level;
  match.outcome = MatchOutcome::matched;
}

void search_blurred(CorrelationSheet& sheet, const ImagePyramid& image, TrackedCamera& camera) {
  const auto matched = std::ranges::count(camera.matches, MatchOutcome::matched, &FeatureMatch::outcome);
  if (image.levels() <= blurred_level || static_cast<double>(matched) >= blurred_share * camera.predicted)
    return;
  for (FeatureMatch& match : camera.matches)
    if (match.outcome == MatchOutcome::not_found)
      accept(match,
             search_feature_at_level(sheet, image, camera.features.at(match.id).view, match, camera,
                                     blurred_level),
             camera.settings.search.min_correlation, blurred_level);
}

}  // namespace

void active_search(const ImagePyramid& image, TrackedCamera& camera) {
  const SearchSettings& settings = camera.settings.search;
  for (FeatureMatch& match : camera.matches) {
    match.expected_information = expected_information(match, camera);
    match.comes_first = settings.anchors_first && match.anchor && is_probable(match, camera);
  }
  std::sort(camera.matches.begin(), camera.matches.end(), [](const FeatureMatch& a, const FeatureMatch& b) {
    if (a.comes_first != b.comes_first) return a.comes_first;
    return a.expected_information != b.expected_information ? a.expected_information > b.expected_information
                                                            : a.id < b.id;
  });
  const int most = camera.most_measurements();
  thread_local CorrelationSheet sheet;
  camera.predicted = 0;
  for (FeatureMatch& match : camera.matches) {
    if (camera.predicted == most) break;
    const PatchView& view = camera.features.at(match.id).view;
    if (!warp(view.texture, match.texture_from_view, settings.patch_size_px)) continue;
    ++camera.predicted;
    match.outcome = MatchOutcome::not_found;
    accept(match, search_feature(sheet, image, view, match, camera), settings.min_correlation, 0);
  }
  search_blurred(sheet, image, camera);
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
