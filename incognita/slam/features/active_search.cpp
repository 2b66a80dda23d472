#include "incognita/slam/features/active_search.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/features/consensus.hpp"
#include "incognita/slam/features/predict_matches.hpp"

namespace incognita {
namespace {

/// Frames without a match after which a matched landmark counts as re-observed. A new landmark is matched in
/// every frame and is the only source of information about its depth.
constexpr int frames_until_away = 15;

}  // namespace

int active_search(const SummedImage& image, const std::vector<Landmark>& catalog,
                  const SearchSettings& settings, std::vector<FeatureMatch>& matches) {
  std::sort(matches.begin(), matches.end(), [](const FeatureMatch& a, const FeatureMatch& b) {
    const double da = a.innovation_cov.determinant(), db = b.innovation_cov.determinant();
    return da != db ? da > db : a.id < b.id;
  });
  thread_local CorrelationSheet sheet;
  int tried = 0;
  for (FeatureMatch& match : matches) {
    if (tried == settings.max_measurements) break;
    const auto patch =
        warp(catalog[match.landmark].view.texture, match.texture_from_view, settings.patch_size_px);
    if (!patch) continue;
    ++tried;
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
  return tried;
}

int reject_outliers(const Estimate& estimate, const CameraSlamSettings& settings,
                    std::vector<FeatureMatch>& matches) {
  std::vector<LinearizedMeasurement> affine;
  std::vector<FeatureMatch*> matched;
  for (FeatureMatch& match : matches) {
    if (match.outcome != MatchOutcome::matched) continue;
    matched.push_back(&match);
    affine.push_back(linearized_measurement(match, estimate.catalog[match.landmark], estimate.camera,
                                            settings.filter.sigma_pixel_px));
  }
  if (matched.empty()) return 0;
  Eigen::MatrixXd S;
  estimate.belief.innovation_covariance(affine, S);
  Eigen::VectorXd residuals(S.rows());
  for (std::size_t i = 0; i < matched.size(); ++i) residuals.segment<2>(2 * i) = affine[i].residual;
  const double gate = chi_square_quantile(settings.search.gate_probability, 2);
  const std::vector<bool> agrees = consistent_matches(residuals, S, gate);
  std::vector<bool> returning;
  for (const FeatureMatch* match : matched)
    returning.push_back(estimate.catalog[match->landmark].frames_away >= frames_until_away);
  const std::vector<bool> alone =
      unconfirmed_matches(S, agrees, returning, settings.search.max_unconfirmed_sigma_px);
  int left = 0;
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (!agrees[i]) matched[i]->outcome = MatchOutcome::outlier;
    if (alone[i]) matched[i]->outcome = MatchOutcome::unconfirmed;
    left += matched[i]->outcome == MatchOutcome::matched;
  }
  return left;
}

}  // namespace incognita
