#include "incognita/slam/features/pose_verification.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/features/consensus.hpp"
#include "incognita/slam/features/each_feature.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/vision/corners.hpp"

namespace incognita {
namespace {

constexpr double max_sigma_px = 15;  // of a search: in a larger ellipse something always matches
// Of a match in a new view, besides the pixel noise: of 480 right poses in rendered rooms 99 % then have a normalized innovation
// squared below its degrees of freedom, half of them below a tenth of it
constexpr double sigma_new_view_px = 0.85;
constexpr double max_sigma_ratio = 0.15;  // of the position, over the distance to the matches

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 6>;

/// d(pixels) / d(pose of the camera) of some matches, one below the other.
Columns pose_jacobian_of(const std::vector<FeatureMatch>& matches) {
  Columns H(2 * static_cast<Eigen::Index>(matches.size()), 6);
  for (std::size_t i = 0; i < matches.size(); ++i)
    H.middleRows<2>(2 * static_cast<Eigen::Index>(i)) = matches[i].Hv.leftCols<6>();
  return H;
}

/// Innovation covariance of some matches without the uncertainty of the camera: H_l P H_l' + R, with this variance of a
/// pixel, px^2.
Eigen::MatrixXd map_covariance_of(const std::vector<FeatureMatch>& matches, const Estimate& e,
                                  const TrackedCamera& camera, double pixel_var) {
  std::vector<LinearizedMeasurement> measurements;
  for (const FeatureMatch& match : matches) {
    const Landmark& landmark = e.landmarks.at(match.id);
    LinearizedMeasurement measurement;
    if (landmark.fixed)
      measurement.add(e.bodies[camera.body].block, CameraJacobian(CameraJacobian::Zero()));
    else
      measurement.add(landmark.block, match.Hl);
    measurement.residual = Eigen::Vector2d::Zero();
    measurement.R = pixel_var * Eigen::Matrix2d::Identity();
    measurements.push_back(measurement);
  }
  Eigen::MatrixXd S;
  e.belief.innovation_covariance(measurements, S);
  return S;
}

/// Of a search, px^2.
double search_var(const TrackedCamera& camera) {
  return std::max(least_sigma_px * least_sigma_px, camera.error_var());
}

std::vector<FeatureMatch> predicted_at(const CameraState& x, const Estimate& e, const TrackedCamera& camera) {
  std::vector<FeatureMatch> matches;
  for_each_feature(e, camera.features, [&](const Landmark& landmark, const Feature& feature) {
    if (landmark.form.kind == LandmarkParametrization::Kind::ray) return;
    auto match = predict_match(landmark, feature.view, e.belief, camera.camera, x, camera.settings);
    if (match) matches.push_back(*std::move(match));
  });
  return matches;
}

/// Searches for a feature in its ellipse. False when it cannot be searched for.
bool search_for(FeatureMatch& match, const Feature& feature, const SummedImage& image,
                const SearchSettings& settings) {
  if (match.innovation_cov.diagonal().maxCoeff() > max_sigma_px * max_sigma_px) return false;
  const auto patch = warp(feature.view.texture, match.texture_from_view, settings.patch_size_px);
  if (!patch) return false;
  thread_local CorrelationSheet sheet;
  match.outcome = MatchOutcome::not_found;
  const auto found =
      search(sheet, image, *patch,
             with_nearest_pixels({match.predicted, match.innovation_cov, settings.gate_sigmas}),
             settings.max_half_axis_px);
  if (!found) return true;
  match.correlation = found->correlation;
  if (found->correlation < settings.min_correlation) return true;
  match.measured = found->pixel;
  match.outcome = MatchOutcome::matched;
  return true;
}

/// Of two landmarks at one corner the more alike counts.
void drop_repeated(std::vector<FeatureMatch>& matches) {
  for (FeatureMatch& match : matches)
    for (const FeatureMatch& other : matches)
      if (match.outcome == MatchOutcome::matched && other.outcome == MatchOutcome::matched &&
          match.id != other.id && (*match.measured - *other.measured).norm() < same_corner_px &&
          match.correlation <= other.correlation)
        match.outcome = MatchOutcome::outlier;
}

std::vector<FeatureMatch> of_outcome(const std::vector<FeatureMatch>& matches, MatchOutcome outcome) {
  std::vector<FeatureMatch> out;
  for (const FeatureMatch& match : matches)
    if (match.outcome == outcome) out.push_back(match);
  return out;
}

Eigen::VectorXd residuals_of(const std::vector<FeatureMatch>& matched) {
  Eigen::VectorXd r(2 * static_cast<Eigen::Index>(matched.size()));
  for (std::size_t i = 0; i < matched.size(); ++i)
    r.segment<2>(2 * static_cast<Eigen::Index>(i)) = *matched[i].measured - matched[i].predicted;
  return r;
}

void reject_inconsistent(std::vector<FeatureMatch>& matches, const Estimate& e, const TrackedCamera& camera,
                         const PoseCov& cov) {
  const std::vector<FeatureMatch> matched = of_outcome(matches, MatchOutcome::matched);
  if (matched.empty()) return;
  const Columns H = pose_jacobian_of(matched);
  const Eigen::MatrixXd S =
      map_covariance_of(matched, e, camera, search_var(camera)) + H * cov * H.transpose();
  const std::vector<bool> agrees = consistent_matches(
      residuals_of(matched), S, chi_square_quantile(camera.settings.search.gate_probability, 2));
  std::size_t i = 0;
  for (FeatureMatch& match : matches)
    if (match.outcome == MatchOutcome::matched && !agrees[i++]) match.outcome = MatchOutcome::outlier;
}

/// The pose by the consistent matches.
std::optional<RefinedPose> pose_of(const std::vector<FeatureMatch>& matches, const Estimate& e,
                                   const TrackedCamera& camera, const CameraState& x) {
  std::vector<PointMatch> points;
  std::vector<int> all;
  for (const FeatureMatch& match : matches) {
    if (match.outcome != MatchOutcome::matched) continue;
    const auto at = position_of(e.landmarks.at(match.id), e);
    if (!at) continue;
    all.push_back(static_cast<int>(points.size()));
    points.push_back({match.id, at->position, at->covariance, *match.measured});
  }
  if (points.size() < 4) return std::nullopt;
  return refine_pose(points, all, camera.camera, x, std::sqrt(search_var(camera)));
}

/// One search about a pose.
std::vector<FeatureMatch> searched_at(const SummedImage& image, const Estimate& e,
                                      const TrackedCamera& camera, const CameraState& x, const PoseCov& cov) {
  std::vector<FeatureMatch> predicted = predicted_at(x, e, camera), matches;
  if (predicted.empty()) return matches;
  const Columns H = pose_jacobian_of(predicted);
  const Eigen::MatrixXd S = map_covariance_of(predicted, e, camera, search_var(camera));
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const Eigen::Index row = 2 * static_cast<Eigen::Index>(i);
    FeatureMatch& match = predicted[i];
    const Eigen::Matrix<double, 2, 6> own = H.middleRows<2>(row);
    match.innovation_cov = S.block<2, 2>(row, row) + own * cov * own.transpose();
    if (search_for(match, camera.features.at(match.id), image, camera.settings.search))
      matches.push_back(std::move(match));
  }
  drop_repeated(matches);
  reject_inconsistent(matches, e, camera, cov);
  return matches;
}

/// Rms distance of pixels from the line that is nearest to them.
double spread_of(const std::vector<FeatureMatch>& matched) {
  Eigen::Vector2d mean(0, 0);
  for (const FeatureMatch& match : matched) mean += *match.measured / static_cast<double>(matched.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const FeatureMatch& match : matched)
    scatter +=
        (*match.measured - mean) * (*match.measured - mean).transpose() / static_cast<double>(matched.size());
  return std::sqrt(std::max(0.0, scatter.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff()));
}

void weigh(PoseEvidence& evidence, const Estimate& e, const TrackedCamera& camera) {
  const std::vector<FeatureMatch> matched = of_outcome(evidence.matches, MatchOutcome::matched);
  evidence.matched = static_cast<int>(matched.size());
  if (matched.empty()) return;
  const Eigen::VectorXd r = residuals_of(matched);
  const double var = camera.error_var() + sigma_new_view_px * sigma_new_view_px;
  evidence.nis = r.dot(map_covariance_of(matched, e, camera, var).llt().solve(r));
  evidence.spread_px = spread_of(matched);
}

/// Mean over the matches.
double distance_to_matches(const PoseEvidence& evidence) {
  double sum_m = 0;
  for (const FeatureMatch& match : evidence.matches)
    if (match.outcome == MatchOutcome::matched)
      sum_m += (match.point - free_camera::position(evidence.camera)).norm();
  return sum_m / std::max(1, evidence.matched);
}

}  // namespace

PoseEvidence gather_evidence(const SummedImage& image, const Estimate& estimate, const TrackedCamera& camera,
                             const CameraState& x, const PoseCov& cov) {
  PoseEvidence evidence;
  evidence.camera = x;
  evidence.cov = cov;
  for (int pass = 0; pass < 2; ++pass) {
    evidence.matches = searched_at(image, estimate, camera, evidence.camera, evidence.cov);
    const auto pose = pose_of(evidence.matches, estimate, camera, evidence.camera);
    if (!pose) return evidence;
    evidence.camera = pose->camera;
    evidence.cov = pose->cov;
  }
  std::vector<FeatureMatch> in_view;  // from the corrected pose
  for (FeatureMatch& match : evidence.matches)
    if (predict_again(match, estimate, camera, evidence.camera)) in_view.push_back(std::move(match));
  evidence.matches = std::move(in_view);
  weigh(evidence, estimate, camera);
  return evidence;
}

PoseEvidence gather_evidence(const SummedImage& image, const Estimate& estimate,
                             const TrackedCamera& camera) {
  const auto pose = pose_of(camera.matches, estimate, camera, camera.view.camera);
  return pose ? gather_evidence(image, estimate, camera, pose->camera, pose->cov) : PoseEvidence{};
}

std::string refusal_of(const PoseEvidence& evidence, const Camera& camera,
                       const CameraSlamSettings& settings) {
  const RelocalizationSettings& limits = settings.relocalization;
  const auto searched = static_cast<double>(evidence.matches.size());
  if (evidence.matched < limits.min_matches) return "too few matches";
  if (evidence.matched < limits.min_matched_share * searched)
    return "too small a share of the features in view matches";
  if (evidence.spread_px < limits.min_spread_share * camera.width())
    return "the matches are on a line, or in one corner of the image";
  if (evidence.nis > 2 * evidence.matched - 6) return "the matches contradict the map";
  const Eigen::Matrix3d cov = evidence.cov.topLeftCorner<3, 3>();
  const double sigma_m = std::sqrt(cov.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff());
  if (sigma_m >
      std::min(settings.health.max_sigma_position_m, max_sigma_ratio * distance_to_matches(evidence)))
    return "the matches do not determine the position";
  return "";
}

std::vector<PointMatch> matched_of(const PoseEvidence& evidence, const std::vector<PointMatch>& landmarks) {
  std::vector<PointMatch> out;
  std::ranges::copy_if(landmarks, std::back_inserter(out), [&](const PointMatch& landmark) {
    return std::ranges::any_of(evidence.matches, [&](const FeatureMatch& match) {
      return match.id == landmark.id && match.outcome == MatchOutcome::matched &&
             (*match.measured - landmark.pixel).norm() < same_corner_px;
    });
  });
  return out;
}

bool matches_most(const PoseEvidence& evidence, const std::vector<PointMatch>& landmarks) {
  return 2 * matched_of(evidence, landmarks).size() > landmarks.size();
}

bool share_matches(const PoseEvidence& a, const PoseEvidence& b) {
  std::vector<PointMatch> matched;
  for (const FeatureMatch& match : b.matches)
    if (match.outcome == MatchOutcome::matched)
      matched.push_back({match.id, match.point, Eigen::Matrix3d::Zero(), *match.measured});
  return matches_most(a, matched);
}

}  // namespace incognita
