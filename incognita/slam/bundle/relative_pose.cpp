#include "incognita/slam/bundle/relative_pose.hpp"

#include <opencv2/calib3d.hpp>

#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

constexpr std::size_t least_rays = 8;
constexpr double confidence = 0.999;  // of RANSAC
/// In displacements of the camera: which of the four solutions is right is decided by nearer points.
constexpr double most_distant = 1000;

std::vector<cv::Point2d> image_points(const std::vector<Eigen::Vector3d>& rays) {
  std::vector<cv::Point2d> points;
  for (const Eigen::Vector3d& ray : rays) points.emplace_back(ray.x() / ray.z(), ray.y() / ray.z());
  return points;
}

}  // namespace

std::optional<RelativePose> relative_pose(const std::vector<Eigen::Vector3d>& first,
                                          const std::vector<Eigen::Vector3d>& second, double tolerance) {
  if (first.size() < least_rays || first.size() != second.size()) return std::nullopt;
  const std::vector<cv::Point2d> a = image_points(first), b = image_points(second);
  const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat inliers, R, t;
  const cv::Mat E = cv::findEssentialMat(a, b, identity, cv::RANSAC, confidence, tolerance, inliers);
  if (E.rows != 3 || E.cols != 3) return std::nullopt;
  RelativePose pose;
  if (cv::recoverPose(E, a, b, identity, R, t, most_distant, inliers) == 0) return std::nullopt;
  for (int i = 0; i < static_cast<int>(a.size()); ++i) pose.is_inlier.push_back(inliers.at<uchar>(i) != 0);
  Eigen::Matrix3d second_from_first;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) second_from_first(i, j) = R.at<double>(i, j);
  const Eigen::Vector3d shift(t.at<double>(0), t.at<double>(1), t.at<double>(2));
  pose.first_from_second = quaternion_from_matrix(second_from_first.transpose());
  pose.direction = -second_from_first.transpose() * shift;
  return pose;
}

}  // namespace incognita
