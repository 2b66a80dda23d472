#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "incognita/slam/features/target_pose.hpp"

namespace incognita {
namespace {

using Normal = Eigen::Matrix<double, 6, 6>;

/// Sum of squared reprojection errors at x, with J'J and J'r over position and right rotation error; negative
/// when a point is not visible.
double reproject(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector2d>& pixels,
                 const Camera& camera, const CameraState& x, Normal& JtJ, Eigen::Matrix<double, 6, 1>& Jtr) {
  JtJ.setZero();
  Jtr.setZero();
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto prediction = PointLandmark::predict_measurement(camera, x, points[i]);
    if (!prediction) return -1;
    const Eigen::Matrix<double, 2, 6> J = prediction->Hv.leftCols<6>();
    const Eigen::Vector2d r = pixels[i] - prediction->pixel;
    JtJ += J.transpose() * J;
    Jtr += J.transpose() * r;
    sum += r.squaredNorm();
  }
  return sum;
}

/// Levenberg-Marquardt iteration from an initial pose; nothing when the target is not visible from there.
std::optional<TargetPose> refine(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<Eigen::Vector2d>& pixels, const Camera& camera,
                                 CameraState x, double sigma_pixel_px) {
  Normal JtJ;
  Eigen::Matrix<double, 6, 1> Jtr;
  double cost = reproject(points, pixels, camera, x, JtJ, Jtr);
  if (cost < 0) return std::nullopt;
  double damping = 1e-3;
  constexpr int max_iterations = 50;
  for (int i = 0; i < max_iterations; ++i) {
    Normal damped = JtJ;
    damped.diagonal() *= 1 + damping;
    Eigen::Matrix<double, 12, 1> step = Eigen::Matrix<double, 12, 1>::Zero();
    step.head<6>() = damped.ldlt().solve(Jtr);
    CameraState moved = x;
    FreeCameraMotion::chart.plus({moved.data(), 13}, {step.data(), 12});
    Normal moved_JtJ;
    Eigen::Matrix<double, 6, 1> moved_Jtr;
    const double moved_cost = reproject(points, pixels, camera, moved, moved_JtJ, moved_Jtr);
    if (moved_cost < 0 || moved_cost > cost) {
      damping *= 10;
      if (damping > 1e8) break;
      continue;
    }
    const bool converged = step.norm() < 1e-10;
    x = moved;
    cost = moved_cost;
    JtJ = moved_JtJ;
    Jtr = moved_Jtr;
    damping = std::max(1e-12, damping / 10);
    if (converged) break;
  }
  TargetPose pose;
  pose.position = free_camera::position(x);
  pose.world_from_camera = free_camera::orientation(x);
  pose.covariance = sigma_pixel_px * sigma_pixel_px * JtJ.ldlt().solve(Normal::Identity());
  pose.pixels = pixels;
  pose.rms_px = std::sqrt(cost / points.size());
  return pose;
}

}  // namespace

std::vector<TargetPose> solve_pose(const std::vector<Eigen::Vector3d>& points,
                                   const std::vector<Eigen::Vector2d>& pixels, const Camera& camera,
                                   double sigma_pixel_px) {
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> rays;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto ray = camera.unproject(pixels[i]);
    if (!ray) return {};
    object.emplace_back(points[i].x(), points[i].y(), points[i].z());
    rays.emplace_back(ray->x(), ray->y());
  }
  std::vector<cv::Mat> rotations, translations;
  cv::solvePnPGeneric(object, rays, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotations, translations, false,
                      cv::SOLVEPNP_IPPE);
  std::vector<TargetPose> poses;
  for (std::size_t k = 0; k < rotations.size(); ++k) {
    const auto at = [](const cv::Mat& m, int i) { return m.at<double>(i); };
    const Eigen::Vector3d turn(at(rotations[k], 0), at(rotations[k], 1), at(rotations[k], 2));
    const Eigen::Vector3d shift(at(translations[k], 0), at(translations[k], 1), at(translations[k], 2));
    if (!turn.allFinite() || !shift.allFinite()) continue;
    CameraState x = CameraState::Zero();
    const Eigen::Vector4d world_from_camera = quaternion_conjugate(quaternion_exp(turn));
    x.head<3>() = -rotation_matrix(world_from_camera) * shift;
    x.segment<4>(3) = world_from_camera;
    if (auto pose = refine(points, pixels, camera, x, sigma_pixel_px)) poses.push_back(*std::move(pose));
  }
  std::sort(poses.begin(), poses.end(),
            [](const TargetPose& a, const TargetPose& b) { return a.rms_px < b.rms_px; });
  if (!poses.empty()) poses[0].second_rms_px = poses.back().rms_px;
  return poses;
}

}  // namespace incognita
