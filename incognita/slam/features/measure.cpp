#include "incognita/slam/features/measure.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/features/consensus.hpp"
#include "incognita/slam/features/predict_looks.hpp"

namespace incognita {
namespace {

/// Frames without a match after which a landmark that is matched again has been away. One that was just born
/// is matched in every frame, and nothing but itself tells its depth.
constexpr int frames_until_away = 15;

}  // namespace

int measure(const SummedImage& image, const std::vector<Landmark>& catalogue, const SearchSettings& settings,
            std::vector<Look>& looks) {
  std::sort(looks.begin(), looks.end(), [](const Look& a, const Look& b) {
    const double da = a.innovation_cov.determinant(), db = b.innovation_cov.determinant();
    return da != db ? da > db : a.id < b.id;
  });
  thread_local CorrelationSheet sheet;
  int tried = 0;
  for (Look& look : looks) {
    if (tried == settings.max_measurements) break;
    const auto patch =
        warp(catalogue[look.landmark].view.texture, look.texture_from_view, settings.patch_size_px);
    if (!patch) continue;
    ++tried;
    look.outcome = LookOutcome::not_found;
    const auto found =
        search(sheet, image, *patch, {look.predicted, look.innovation_cov, settings.gate_sigmas},
               settings.max_half_axis_px);
    if (!found) continue;
    look.correlation = found->correlation;
    if (found->correlation < settings.min_correlation) continue;
    look.measured = found->pixel;
    look.outcome = LookOutcome::matched;
  }
  return tried;
}

int reject_inconsistent(const Estimate& estimate, const CameraSlamSettings& settings,
                        std::vector<Look>& looks) {
  std::vector<AffineLook> affine;
  std::vector<Look*> matched;
  for (Look& look : looks) {
    if (look.outcome != LookOutcome::matched) continue;
    matched.push_back(&look);
    affine.push_back(affine_look(look, estimate.catalogue[look.landmark], estimate.camera,
                                 settings.filter.sigma_pixel_px));
  }
  if (matched.empty()) return 0;
  Eigen::MatrixXd S;
  estimate.belief.innovation_covariance(affine, S);
  Eigen::VectorXd residuals(S.rows());
  for (std::size_t i = 0; i < matched.size(); ++i) residuals.segment<2>(2 * i) = affine[i].residual;
  const double gate = chi_square_quantile(settings.search.gate_probability, 2);
  const std::vector<bool> agrees = agreeing_matches(residuals, S, gate);
  std::vector<bool> returning;
  for (const Look* look : matched)
    returning.push_back(estimate.catalogue[look->landmark].frames_away >= frames_until_away);
  const std::vector<bool> alone = matches_alone(S, agrees, returning, settings.search.max_alone_sigma_px);
  int left = 0;
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (!agrees[i]) matched[i]->outcome = LookOutcome::inconsistent;
    if (alone[i]) matched[i]->outcome = LookOutcome::alone;
    left += matched[i]->outcome == LookOutcome::matched;
  }
  return left;
}

}  // namespace incognita
