#include "incognita/vision/calibration/fit_lens.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace incognita {
namespace {

/// The correspondences in OpenCV's types, and the poses of the boards that a fit finds.
struct Problem {
  std::vector<std::vector<cv::Point3d>> boards;
  std::vector<std::vector<cv::Point2d>> pixels;
  cv::Size size;
  cv::Matx33d K = cv::Matx33d::eye();
  cv::Mat distortion;
  std::vector<cv::Mat> rotations, translations;
};

Problem problem_of(const std::vector<std::vector<Eigen::Vector2d>>& views, const BoardSize& board,
                   int width_px, int height_px) {
  Problem problem;
  problem.size = {width_px, height_px};
  std::vector<cv::Point3d> plan;
  for (int row = 0; row < board.rows; ++row)
    for (int column = 0; column < board.columns; ++column) plan.emplace_back(column, row, 0);
  for (const auto& corners : views) {
    problem.boards.push_back(plan);
    problem.pixels.emplace_back();
    for (const Eigen::Vector2d& corner : corners) problem.pixels.back().emplace_back(corner.x(), corner.y());
  }
  return problem;
}

/// calibrateCamera takes points of single precision only.
std::vector<std::vector<cv::Point3f>> single(const std::vector<std::vector<cv::Point3d>>& points) {
  std::vector<std::vector<cv::Point3f>> out;
  for (const auto& view : points) out.emplace_back(view.begin(), view.end());
  return out;
}
std::vector<std::vector<cv::Point2f>> single(const std::vector<std::vector<cv::Point2d>>& points) {
  std::vector<std::vector<cv::Point2f>> out;
  for (const auto& view : points) out.emplace_back(view.begin(), view.end());
  return out;
}

void fit_pinhole(Problem& problem, bool third_radial) {
  const int fixed = third_radial ? 0 : cv::CALIB_FIX_K3;
  cv::calibrateCamera(single(problem.boards), single(problem.pixels), problem.size, problem.K,
                      problem.distortion, problem.rotations, problem.translations, fixed,
                      {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-10});
}

void fit_fisheye(Problem& problem) {
  cv::fisheye::calibrate(problem.boards, problem.pixels, problem.size, problem.K, problem.distortion,
                         problem.rotations, problem.translations,
                         cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW,
                         {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-10});
}

/// Residuals of a view, 2n, and their derivatives by the parameters of the lens (fu fv u0 v0, distortion), 2n x 9 or 8, and by
/// the pose of the board, 2n x 6.
struct Linearized {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd by_lens, by_pose;
};

Eigen::MatrixXd columns_of(const cv::Mat& all, int first, int count) {
  Eigen::MatrixXd out(all.rows, count);
  for (int i = 0; i < all.rows; ++i)
    for (int j = 0; j < count; ++j) out(i, j) = all.at<double>(i, first + j);
  return out;
}

Linearized linearize(const Problem& problem, std::size_t view, LensModel model) {
  std::vector<cv::Point2d> projected;
  cv::Mat J;
  Linearized out;
  const cv::Mat &r = problem.rotations[view], &t = problem.translations[view];
  if (model == LensModel::fisheye) {  // columns: f, c, k1..k4, rotation, translation, skew
    cv::fisheye::projectPoints(problem.boards[view], projected, r, t, problem.K, problem.distortion, 0, J);
    out.by_lens = columns_of(J, 0, 8);
    out.by_pose = columns_of(J, 8, 6);
  } else {  // columns: rotation, translation, f, c, k1 k2 p1 p2 k3
    cv::projectPoints(problem.boards[view], r, t, problem.K, problem.distortion, projected, J);
    out.by_lens = columns_of(J, 6, 9);
    out.by_pose = columns_of(J, 0, 6);
  }
  out.residuals.resize(2 * static_cast<Eigen::Index>(projected.size()));
  for (std::size_t i = 0; i < projected.size(); ++i) {
    const cv::Point2d off = problem.pixels[view][i] - projected[i];
    out.residuals.segment<2>(2 * static_cast<Eigen::Index>(i)) << off.x, off.y;
  }
  return out;
}

/// Standard deviations of the first `fitted` parameters of the lens: their block of the inverse normal matrix, from which the
/// poses are eliminated, times the variance of the residuals. Empty if the matrix is singular.
Eigen::VectorXd sigmas_of(const std::vector<Linearized>& views, Eigen::Index fitted) {
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(fitted, fitted);
  double squares = 0;
  Eigen::Index residuals = 0;
  for (const Linearized& view : views) {
    const Eigen::MatrixXd A = view.by_lens.leftCols(fitted), &B = view.by_pose;
    const Eigen::MatrixXd AtB = A.transpose() * B, BtB = B.transpose() * B;
    information += A.transpose() * A - AtB * BtB.ldlt().solve(AtB.transpose());
    squares += view.residuals.squaredNorm();
    residuals += view.residuals.size();
  }
  const Eigen::Index freedom = residuals - fitted - 6 * static_cast<Eigen::Index>(views.size());
  // Scaled to a unit diagonal: the columns differ by factors of a thousand
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factor(scale.asDiagonal() * information * scale.asDiagonal());
  if (freedom <= 0 || factor.info() != Eigen::Success) return {};
  const Eigen::MatrixXd covariance = factor.solve(Eigen::MatrixXd::Identity(fitted, fitted));
  return (covariance.diagonal().cwiseSqrt().cwiseProduct(scale)) *
         std::sqrt(squares / static_cast<double>(freedom));
}

BoardPose pose_of(const cv::Mat& rotation, const cv::Mat& translation, const BoardSize& board) {
  cv::Matx33d R;
  cv::Rodrigues(rotation, R);
  const cv::Vec3d t(translation.at<double>(0), translation.at<double>(1), translation.at<double>(2));
  const cv::Vec3d center = R * cv::Vec3d((board.columns - 1) / 2.0, (board.rows - 1) / 2.0, 0) + t;
  return {cv::norm(center), std::acos(std::min(1.0, std::abs(R(2, 2))))};
}

void add_errors(const std::vector<Linearized>& views, LensFit& fit) {
  double squares = 0, corners = 0;
  for (const Linearized& view : views) {
    const double of_view = view.residuals.squaredNorm(),
                 count = static_cast<double>(view.residuals.size()) / 2;
    fit.view_rms_px.push_back(std::sqrt(of_view / count));
    squares += of_view, corners += count;
  }
  fit.rms_px = std::sqrt(squares / corners);
}

LensFit fit_of(const Problem& problem, const BoardSize& board, const LensFitSettings& settings) {
  LensFit fit;
  fit.model = settings.model;
  std::vector<Linearized> views;
  for (std::size_t i = 0; i < problem.boards.size(); ++i)
    views.push_back(linearize(problem, i, settings.model));
  add_errors(views, fit);
  for (std::size_t i = 0; i < problem.rotations.size(); ++i)
    fit.boards.push_back(pose_of(problem.rotations[i], problem.translations[i], board));
  const bool without_k3 = settings.model == LensModel::pinhole && !settings.third_radial;
  const Eigen::VectorXd sigma = sigmas_of(views, without_k3 ? 8 : views.front().by_lens.cols());
  if (sigma.size() == 0 || !sigma.allFinite()) {
    fit.failure = "the views do not determine the parameters of the lens";
    return fit;
  }
  const auto sigma_at = [&](Eigen::Index i) { return i < sigma.size() ? sigma[i] : 0; };
  fit.fu = {problem.K(0, 0), sigma[0]}, fit.fv = {problem.K(1, 1), sigma[1]};
  fit.u0 = {problem.K(0, 2), sigma[2]}, fit.v0 = {problem.K(1, 2), sigma[3]};
  for (int i = 0; i < static_cast<int>(problem.distortion.total()); ++i)
    fit.distortion.push_back({problem.distortion.at<double>(i), sigma_at(4 + i)});
  if (!std::isfinite(fit.rms_px) || !std::isfinite(fit.fu.value + fit.fv.value + fit.u0.value + fit.v0.value))
    fit.failure = "the optimization diverged";
  return fit;
}

}  // namespace

LensFit fit_lens(const std::vector<std::vector<Eigen::Vector2d>>& views, const BoardSize& board, int width_px,
                 int height_px, const LensFitSettings& settings) {
  LensFit failed;
  failed.model = settings.model;
  if (views.empty()) {
    failed.failure = "there is no view";
    return failed;
  }
  Problem problem = problem_of(views, board, width_px, height_px);
  try {
    if (settings.model == LensModel::fisheye)
      fit_fisheye(problem);
    else
      fit_pinhole(problem, settings.third_radial);
    return fit_of(problem, board, settings);
  } catch (const cv::Exception& error) {
    failed.failure = "the optimization has no solution (OpenCV: " + error.err + ")";
    return failed;
  }
}

}  // namespace incognita
