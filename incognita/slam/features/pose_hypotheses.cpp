#include "incognita/slam/features/pose_hypotheses.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "incognita/vision/corners.hpp"

namespace incognita {
namespace {

double turn_between(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  return 2 * std::acos(std::min(1.0, std::abs(a.dot(b))));
}

/// Whether two matches can be of the same image: their landmarks and pixels differ, and the poses that either tells
/// are alike, within the change of the viewing direction under which a landmark is recognized.
bool are_compatible(const PointMatch& a, const PointMatch& b, const PoseLimits& limits) {
  if (a.id == b.id || (a.pixel - b.pixel).norm() < same_corner_px) return false;
  if (!a.expected || !b.expected) return true;
  if (turn_between(free_camera::orientation(*a.expected), free_camera::orientation(*b.expected)) >
      limits.max_turn_rad)
    return false;
  const Eigen::Vector3d at = free_camera::position(*a.expected), other = free_camera::position(*b.expected);
  // Either position is wrong by the distance of its landmark times the error of the turn and of the logarithm of the scale
  return (at - other).norm() < 0.7 * ((at - a.point).norm() + (other - b.point).norm());
}

/// Whether a camera can recognize the landmark of a match from there.
bool is_recognizable(const PointMatch& match, const CameraState& from, const PoseLimits& limits) {
  const Eigen::Vector3d now = match.point - Eigen::Vector3d(free_camera::position(from)),
                        then = match.point - match.first_view;
  const double now_m = now.norm(), then_m = then.norm();
  if (now_m < 1e-6 || then_m < 1e-6) return false;
  if (now.dot(then) < std::cos(limits.max_view_angle_rad) * now_m * then_m) return false;
  if (now_m > then_m * limits.max_scale || then_m > now_m * limits.max_scale) return false;
  return !match.expected || turn_between(free_camera::orientation(*match.expected),
                                         free_camera::orientation(from)) < limits.max_turn_rad;
}

/// Squared reprojection error relative to the tolerance; nothing for one above it.
std::optional<double> relative_error(const PointMatch& match, const Camera& camera, const CameraState& from,
                                     const PoseLimits& limits) {
  const Eigen::Vector3d at = PointLandmark::in_camera<double>(from, match.point);
  const auto projected = camera.project(at);
  if (!projected) return std::nullopt;
  const double error2 = (projected->pixel - match.pixel).squaredNorm();
  // The largest that a tolerance can be: saves most matches the covariance
  const double per_m = projected->J.norm();
  const double sigma_px = per_m * std::sqrt(match.cov.trace());
  const double tolerance = limits.tolerance_px + 2 * std::min(sigma_px, 2 * limits.tolerance_px);
  if (error2 > tolerance * tolerance || !is_recognizable(match, from, limits)) return std::nullopt;
  return error2 / (tolerance * tolerance);
}

struct Explained {
  std::vector<int> matches;
  double score = 0;  ///< number of matches less their relative errors
};

/// The matches that a pose explains: of each landmark and of each pixel the best.
Explained explained_by(const CameraState& from, const std::vector<PointMatch>& matches, const Camera& camera,
                       const PoseLimits& limits) {
  Explained out;
  std::vector<std::pair<double, int>> errors;
  for (int i = 0; i < static_cast<int>(matches.size()); ++i)
    if (const auto error = relative_error(matches[static_cast<std::size_t>(i)], camera, from, limits))
      errors.emplace_back(*error, i);
  std::sort(errors.begin(), errors.end());
  for (const auto& [error, i] : errors) {
    const PointMatch& match = matches[static_cast<std::size_t>(i)];
    const bool is_taken = std::ranges::any_of(out.matches, [&](int other) {
      const PointMatch& o = matches[static_cast<std::size_t>(other)];
      return o.id == match.id || (o.pixel - match.pixel).norm() < same_corner_px;
    });
    if (is_taken) continue;
    out.matches.push_back(i);
    out.score += 1 - 0.5 * error;
  }
  return out;
}

/// Up to four poses of a camera that sees three points along three rays (x, y, 1).
std::vector<CameraState> solve_p3p(const std::array<const PointMatch*, 3>& sample,
                                   const std::array<Eigen::Vector3d, 3>& rays) {
  std::array<cv::Point3d, 3> points;
  std::array<cv::Point2d, 3> pixels;
  for (std::size_t k = 0; k < 3; ++k) {
    points[k] = {sample[k]->point.x(), sample[k]->point.y(), sample[k]->point.z()};
    pixels[k] = {rays[k].x(), rays[k].y()};
  }
  std::vector<cv::Mat> rotations, translations;
  cv::solveP3P(cv::Mat(3, 1, CV_64FC3, points.data()), cv::Mat(3, 1, CV_64FC2, pixels.data()),
               cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotations, translations, cv::SOLVEPNP_AP3P);
  std::vector<CameraState> poses;
  for (std::size_t k = 0; k < rotations.size(); ++k) {
    const auto at = [](const cv::Mat& m, int i) { return m.at<double>(i); };
    const Eigen::Vector3d turn(at(rotations[k], 0), at(rotations[k], 1), at(rotations[k], 2));
    const Eigen::Vector3d shift(at(translations[k], 0), at(translations[k], 1), at(translations[k], 2));
    if (!turn.allFinite() || !shift.allFinite()) continue;
    CameraState x = CameraState::Zero();
    const Eigen::Vector4d world_from_camera = quaternion_conjugate(quaternion_exp(turn));
    x.head<3>() = -rotation_matrix(world_from_camera) * shift;
    x.segment<4>(3) = world_from_camera;
    poses.push_back(x);
  }
  return poses;
}

/// One of them, the earlier ones more often: they are more alike (as in PROSAC: O. Chum, J. Matas, CVPR 2005).
int draw_early(const std::vector<int>& from, RandomStream& random) {
  const double u = random.uniform(0, 1);
  const auto count = static_cast<double>(from.size());
  return from[std::min(static_cast<std::size_t>(u * u * count), from.size() - 1)];
}

/// Draws three compatible matches, of them one of `first`; nothing when a draw fails.
std::optional<std::array<int, 3>> draw(const std::vector<std::vector<int>>& compatible,
                                       const std::vector<int>& first, const std::vector<PointMatch>& matches,
                                       const PoseLimits& limits, RandomStream& random) {
  const int i = draw_early(first, random);
  const std::vector<int>& others = compatible[static_cast<std::size_t>(i)];
  const int j = draw_early(others, random), k = draw_early(others, random);
  const PointMatch &b = matches[static_cast<std::size_t>(j)], &c = matches[static_cast<std::size_t>(k)];
  if (!are_compatible(b, c, limits)) return std::nullopt;
  return std::array<int, 3>{i, j, k};
}

struct Scored {
  CameraState camera;
  Explained explained;
};

/// Least squares over what a pose explains, which may then explain more.
std::optional<PoseHypothesis> refined(const Scored& scored, const std::vector<PointMatch>& matches,
                                      const Camera& camera, const PoseLimits& limits, double sigma_pixel_px) {
  CameraState x = scored.camera;
  std::vector<int> used = scored.explained.matches;
  std::optional<RefinedPose> pose;
  for (int i = 0; i < 3; ++i) {
    pose = refine_pose(matches, used, camera, x, sigma_pixel_px);
    if (!pose) return std::nullopt;
    x = pose->camera;
    std::vector<int> now = explained_by(x, matches, camera, limits).matches;
    if (now.size() < static_cast<std::size_t>(limits.min_matches)) return std::nullopt;
    if (now == used) break;
    used = std::move(now);
  }
  const auto distinctive =
      std::ranges::count_if(used, [&](int i) { return matches[static_cast<std::size_t>(i)].is_distinctive; });
  return PoseHypothesis{pose->camera, pose->cov, std::move(used), static_cast<int>(distinctive), pose->cost};
}

bool shares_matches(const PoseHypothesis& a, const PoseHypothesis& b) {
  const auto in_a = [&](int i) { return std::ranges::find(a.matches, i) != a.matches.end(); };
  return 2 * static_cast<std::size_t>(std::ranges::count_if(b.matches, in_a)) > b.matches.size();
}

}  // namespace

std::vector<PoseHypothesis> find_poses(const std::vector<PointMatch>& matches, const Camera& camera,
                                       const PoseLimits& limits, double sigma_pixel_px,
                                       RandomStream& random) {
  const int n = static_cast<int>(matches.size());
  std::vector<std::vector<int>> compatible(matches.size());
  std::vector<int> first, distinctive;  // matches to draw the first of three from
  std::vector<Eigen::Vector3d> rays;
  for (const PointMatch& match : matches) {
    const auto ray = camera.unproject(match.pixel);
    rays.push_back(ray.value_or(Eigen::Vector3d::Zero()));
  }
  for (int i = 0; i < n; ++i) {
    if (rays[static_cast<std::size_t>(i)].isZero(0)) continue;
    for (int j = 0; j < n; ++j)
      if (!rays[static_cast<std::size_t>(j)].isZero(0) &&
          are_compatible(matches[static_cast<std::size_t>(i)], matches[static_cast<std::size_t>(j)], limits))
        compatible[static_cast<std::size_t>(i)].push_back(j);
    if (static_cast<int>(compatible[static_cast<std::size_t>(i)].size()) < limits.min_matches - 1) continue;
    first.push_back(i);
    if (matches[static_cast<std::size_t>(i)].is_distinctive) distinctive.push_back(i);
  }
  std::vector<Scored> scored;
  for (int s = 0; !first.empty() && s < limits.samples; ++s) {
    const bool from_distinctive = s % 2 == 0 && !distinctive.empty();
    const auto drawn = draw(compatible, from_distinctive ? distinctive : first, matches, limits, random);
    if (!drawn) continue;
    const auto [i, j, k] = *drawn;
    const auto at = [&](int which) { return static_cast<std::size_t>(which); };
    for (const CameraState& x : solve_p3p({&matches[at(i)], &matches[at(j)], &matches[at(k)]},
                                          {rays[at(i)], rays[at(j)], rays[at(k)]})) {
      if (!is_recognizable(matches[at(i)], x, limits) || !is_recognizable(matches[at(j)], x, limits) ||
          !is_recognizable(matches[at(k)], x, limits))
        continue;
      Explained explained = explained_by(x, matches, camera, limits);
      if (explained.matches.size() >= static_cast<std::size_t>(limits.min_matches))
        scored.push_back({x, std::move(explained)});
    }
  }
  std::stable_sort(scored.begin(), scored.end(),
                   [](const Scored& a, const Scored& b) { return a.explained.score > b.explained.score; });
  std::vector<PoseHypothesis> out;
  const std::size_t tried = std::min(scored.size(), static_cast<std::size_t>(8 * limits.max_hypotheses));
  for (std::size_t s = 0; s < tried && out.size() < static_cast<std::size_t>(limits.max_hypotheses); ++s) {
    auto pose = refined(scored[s], matches, camera, limits, sigma_pixel_px);
    if (!pose) continue;
    if (std::ranges::none_of(out,
                             [&](const PoseHypothesis& better) { return shares_matches(better, *pose); }))
      out.push_back(*std::move(pose));
  }
  std::stable_sort(out.begin(), out.end(), [](const PoseHypothesis& a, const PoseHypothesis& b) {
    return a.matches.size() > b.matches.size();
  });
  return out;
}

namespace {

struct Equations {
  PoseCov information = PoseCov::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
  double cost = 0;
};

std::optional<Equations> equations_at(const CameraState& x, const std::vector<PointMatch>& matches,
                                      const std::vector<int>& used, const Camera& camera,
                                      double sigma_pixel_px) {
  Equations e;
  for (const int i : used) {
    const PointMatch& match = matches[static_cast<std::size_t>(i)];
    const auto prediction = PointLandmark::predict_measurement(camera, x, match.point);
    if (!prediction) return std::nullopt;
    const Eigen::Matrix<double, 2, 6> J = prediction->Hv.leftCols<6>();
    const Eigen::Matrix2d W = (sigma_pixel_px * sigma_pixel_px * Eigen::Matrix2d::Identity() +
                               prediction->Hl * match.cov * prediction->Hl.transpose())
                                  .inverse();
    const Eigen::Vector2d r = match.pixel - prediction->pixel;
    e.information += J.transpose() * W * J;
    e.gradient += J.transpose() * W * r;
    e.cost += r.dot(W * r);
  }
  return e;
}

}  // namespace

std::optional<RefinedPose> refine_pose(const std::vector<PointMatch>& matches, const std::vector<int>& used,
                                       const Camera& camera, const CameraState& start,
                                       double sigma_pixel_px) {
  CameraState x = start;
  auto now = equations_at(x, matches, used, camera, sigma_pixel_px);
  if (!now) return std::nullopt;
  constexpr int max_iterations = 15;
  double damping = 1e-4;
  for (int i = 0; i < max_iterations; ++i) {
    PoseCov damped = now->information;
    damped.diagonal() *= 1 + damping;
    Eigen::Matrix<double, 12, 1> step = Eigen::Matrix<double, 12, 1>::Zero();
    step.head<6>() = damped.ldlt().solve(now->gradient);
    CameraState moved = x;
    FreeCameraMotion::chart.plus({moved.data(), 13}, {step.data(), 12});
    auto there = equations_at(moved, matches, used, camera, sigma_pixel_px);
    if (!there || there->cost > now->cost) {
      damping *= 10;
      if (damping > 1e4) break;
      continue;
    }
    x = moved;
    now = std::move(there);
    damping = std::max(1e-9, damping / 10);
    if (step.norm() < 1e-6) break;
  }
  const Eigen::LLT<PoseCov> llt(now->information);
  if (llt.info() != Eigen::Success || !x.allFinite()) return std::nullopt;
  const PoseCov cov = llt.solve(PoseCov::Identity());
  if (!cov.allFinite()) return std::nullopt;
  return RefinedPose{x, (cov + cov.transpose()) / 2, now->cost};
}

}  // namespace incognita
