// The rotation between two frames from whole images, and the search that it guides.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/slam/features/active_search.hpp"
#include "incognita/slam/features/align_rotation.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

const Wall wall(2);

/// The camera at the origin, turned by a rotation vector in its own axes.
CameraState turned(const Eigen::Vector3d& by) {
  CameraState x = origin;
  x.segment<4>(3) =
      quaternion_product<double>(Eigen::Vector4d(origin.segment<4>(3)), quaternion_exp<double>(by));
  return x;
}

SmallImage small(const Image& image) {
  SmallImage out;
  out.assign(image);
  return out;
}

std::optional<RotationAlignment> aligned(const Image& before, const Image& now) {
  const SmallImage first = small(before);
  return align_rotation(first, small(now), rays_of(first, camera), camera);
}

TEST(AlignRotation, FindsTheTurnAboutEveryAxis) {
  for (const Eigen::Vector3d& by :
       {Eigen::Vector3d(0.05, 0, 0), Eigen::Vector3d(0, -0.06, 0), Eigen::Vector3d(0, 0, 0.1),
        Eigen::Vector3d(0.03, 0.05, -0.05), Eigen::Vector3d(0, 0, 0)}) {
    const auto found = aligned(wall.seen_from(origin), wall.seen_from(turned(by)));
    ASSERT_TRUE(found) << by.transpose();
    const Eigen::AngleAxisd error(found->rotation * rotation_exp<double>(by));
    EXPECT_LT(std::abs(error.angle()), 0.004) << by.transpose() << ": less than a pixel";
    EXPECT_LE(found->rms, found->rms_initial);
  }
}

TEST(AlignRotation, DoesNotDependOnTheExposure) {
  const Eigen::Vector3d by(0.02, 0.04, 0);
  Image darker = wall.seen_from(turned(by));
  for (int v = 0; v < darker.height(); ++v)
    for (int u = 0; u < darker.width(); ++u) darker(u, v) = static_cast<std::uint8_t>(10 + darker(u, v) / 2);
  const auto found = aligned(wall.seen_from(origin), darker);
  ASSERT_TRUE(found);
  EXPECT_LT(std::abs(Eigen::AngleAxisd(found->rotation * rotation_exp<double>(by)).angle()), 0.004);
}

TEST(AlignRotation, NotWithoutContrast) {
  EXPECT_FALSE(aligned(Image(model.width, model.height, 90), Image(model.width, model.height, 90)));
}

/// Well-known landmarks of a camera that turned by 0.1 rad, 20 px, while its filter expects less than a tenth of it.
struct Turned : Tracking {
  static constexpr double turn_rad = 0.1;
  Image image = wall.seen_from(turned({0, turn_rad, 0}));

  static CameraCov uncertain(double sigma_rad) {
    CameraCov P = 1e-8 * CameraCov::Identity();
    P.block<3, 3>(3, 3) = sigma_rad * sigma_rad * Eigen::Matrix3d::Identity();
    return P;
  }
  explicit Turned(double sigma_rad = 0.05) : Tracking(origin, uncertain(sigma_rad)) {
    tracked.settings.search = {.max_measurements = 20};
    const Image first = wall.seen_from(origin);
    const auto corners = wall.corners_in_view(origin, 60);
    for (std::size_t i = 0; i < corners.size(); i += 7)
      add_point(first, origin, corners[i], corners[i], 1e-3);
  }
  /// Of the searches that found their corner, to less than a pixel: their share, and the rms distance, px.
  struct Right {
    double share, rms_px;
  };
  Right right(int levels) {
    predict_matches(estimate, tracked);
    active_search(ImagePyramid(image, levels), tracked);
    int right = 0;
    double squares = 0;
    for (const FeatureMatch& match : tracked.matches) {
      if (match.outcome != MatchOutcome::matched) continue;
      const double off = (*match.measured - pixel_of(turned({0, turn_rad, 0}), match.point)).norm();
      if (off >= 1) continue;
      ++right;
      squares += off * off;
    }
    return {static_cast<double>(right) / tracked.predicted, std::sqrt(squares / right)};
  }
  double found(int levels) { return right(levels).share; }
};

TEST(CoarseSearch, FindsWhatTheWholeEllipseHolds) {
  EXPECT_GT(Turned().found(4), 0.8);
  EXPECT_GT(Turned().found(1), 0.7) << "at full resolution, as in the thesis";
}

TEST(CoarseSearch, TheAlignmentGuidesIt) {
  Turned scene;
  scene.tracked.guide = rotation_exp<double>(Eigen::Vector3d(0, -Turned::turn_rad, 0));
  EXPECT_GT(scene.found(4), 0.9);
}

TEST(CoarseSearch, EndsAtAFractionOfAPixel) {
  Turned scene;
  EXPECT_LT(scene.right(4).rms_px, 0.11) << "0.14 px at the peak of the correlation";
  Turned guided;
  guided.tracked.guide = rotation_exp<double>(Eigen::Vector3d(0, -Turned::turn_rad, 0));
  EXPECT_LT(guided.right(4).rms_px, 0.11);
}

/// The mean of the 15 images of a camera that turns by `blur_px` in the middle of the image.
Image blurred(double blur_px) {
  constexpr int images = 15;
  const double blur_rad = blur_px / 195.0;
  std::vector<double> sums(static_cast<std::size_t>(model.width) * model.height);
  for (int k = 0; k < images; ++k) {
    const Image one = wall.seen_from(turned({0, blur_rad * (k / (images - 1.0) - 0.5), 0}));
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += *(one.row(0) + i);
  }
  Image mean(model.width, model.height);
  for (std::size_t i = 0; i < sums.size(); ++i)
    *(mean.row(0) + i) = static_cast<std::uint8_t>(std::lround(sums[i] / images));
  return mean;
}

TEST(CoarseSearch, BlurredImagesMatchAtHalfTheResolution) {
  const Image image = blurred(20);
  const auto matched_at = [&](int levels) {
    Turned scene(0.005);  // a pixel: the camera is where the filter expects it
    predict_matches(scene.estimate, scene.tracked);
    active_search(ImagePyramid(image, levels), scene.tracked);
    std::array<int, 2> count{};
    for (const FeatureMatch& match : scene.tracked.matches)
      if (match.outcome == MatchOutcome::matched) ++count.at(static_cast<std::size_t>(match.level));
    return count;
  };
  const auto fine = matched_at(1), both = matched_at(4);
  EXPECT_EQ(fine[1], 0);
  EXPECT_GT(both[1], 0);
  EXPECT_GT(both[0] + both[1], fine[0]);
  FeatureMatch match{};
  TrackedCamera any{.camera = camera};
  const double sharp = match_var(match, any);
  match.level = 1;
  EXPECT_DOUBLE_EQ(match_var(match, any), 4 * sharp) << "its pixels are twice as large";
}

/// A camera that starts at rest in its filter's view, and in truth moves at once by 5 m/s and 2 rad/s.
TEST(StartInMotion, IsTrackedFromTheFirstFrame) {
  SlamEstimator estimator = single_camera(camera, {}, {}, 10, 1);
  Estimate estimate;
  CameraState truth = origin;
  truth.segment<3>(7) = Eigen::Vector3d(0, 1, 0.3);
  truth.tail<3>() = Eigen::Vector3d(0.5, 1, 0.2);
  int least = 1000;
  for (int k = 0; k < 20; ++k) {
    const Image image = wall.seen_from(truth);
    estimator.update(estimate, {}, seeing(std::make_shared<const Image>(image)), tick(k));
    if (k > 0) least = std::min(least, estimate.last.image_matches);
    truth = FreeCameraMotion{}.f<double>(truth, FreeCameraMotion::Input<double>::Zero(), 1 / 30.0);
  }
  EXPECT_EQ(estimate.status.state, TrackingState::tracking);
  EXPECT_GE(least, 8);
}

}  // namespace
}  // namespace incognita
