// Planes of patches, on pictures of a tilted texture cast ray by ray.
#include "incognita/slam/features/patch_plane.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "incognita/models/sensors/pinhole_camera.hpp"
#include "incognita/slam/features/estimate_patch_planes.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/vision/search.hpp"
#include "tests/vision/pattern.hpp"

namespace incognita {
namespace {

const Eigen::Vector3d point(0, 0, 2);  // world: the first camera's axes
constexpr int patch_size_px = 11;
constexpr double step = 0.1;

/// A wall through `point`, tilted by slopes about the plane that faces the first camera.
struct PatchWall {
  Eigen::Vector3d normal;
  Pattern pattern{3, 40};
  Eigen::Vector3d right = normal.cross(Eigen::Vector3d::UnitY()).normalized(), down = normal.cross(right);

  Image seen_from(const CameraState& x, const Camera& camera) const {
    Image image(camera.width(), camera.height());
    const Eigen::Matrix3d R = rotation_matrix<double>(free_camera::orientation(x));
    const Eigen::Vector3d from = free_camera::position(x);
    for (int v = 90; v < 150; ++v)  // nobody looks elsewhere
      for (int u = 130; u < 190; ++u) {
        const Eigen::Vector3d along = R * *camera.unproject(Eigen::Vector2d(u, v));
        const Eigen::Vector3d at = from + along * (normal.dot(point - from) / normal.dot(along)) - point;
        const double gray = 128 + pattern(100 * at.dot(right), 100 * at.dot(down));  // waves of 6 to 16 cm
        image(u, v) = static_cast<std::uint8_t>(std::clamp(std::lround(gray), 0l, 255l));
      }
    return image;
  }
};

/// On an arc around the point, looking at it, turned by `angle` about the camera's own vertical.
CameraState on_arc(double angle, const Eigen::Vector3d& about) {
  const Eigen::AngleAxisd turn(angle, about);
  CameraState x = CameraState::Zero();
  x.head<3>() = point - turn * point;
  x.segment<4>(3) = quaternion_from_matrix(turn.toRotationMatrix());
  return x;
}

class PatchPlanes : public ::testing::TestWithParam<std::pair<double, double>> {
 protected:
  Eigen::Vector2d truth{GetParam().first, GetParam().second};
  Camera camera = PinholeCamera{};
  Eigen::Vector2d pixel{159.5, 119.5};
  PatchView view;
  PatchWall wall{plane().normal(truth)};

  static PatchPlane plane() {
    PatchPlane facing;
    facing.facing = -Eigen::Vector3d::UnitZ();
    facing.slope_cov = 0.49 * Eigen::Matrix2d::Identity();
    return facing;
  }
  void SetUp() override {
    const CameraState first = on_arc(0, Eigen::Vector3d::UnitY());
    view = {*cut_texture(wall.seen_from(first, camera), pixel, 27, 6),
            {},
            pixel,
            Eigen::Vector3d::Zero(),
            free_camera::orientation(first),
            plane()};
  }
  PatchTemplate expected(const Eigen::Vector2d& slope, const CameraState& from) const {
    const auto map = local_warp(view, view.plane.normal(slope), point, pixel, camera, from);
    return *warp(view.texture, *map, patch_size_px);
  }
  PlaneEvidence evidence(const Image& image, const CameraState& from) const {
    const Eigen::Vector2d now = view.plane.slope;
    return *plane_evidence(
        image, pixel, expected(now, from),
        {expected(now + Eigen::Vector2d(step, 0), from), expected(now + Eigen::Vector2d(0, step), from)},
        step);
  }
};

TEST_P(PatchPlanes, AreLearntByLookingFromElsewhere) {
  for (int i = 1; i <= 12; ++i)
    for (const Eigen::Vector3d& about :
         {Eigen::Vector3d(Eigen::Vector3d::UnitY()), Eigen::Vector3d(Eigen::Vector3d::UnitX())}) {
      const CameraState from = on_arc(0.04 * i, about);
      update_patch_plane(view.plane, evidence(wall.seen_from(from, camera), from));
    }
  const Eigen::Vector2d error = view.plane.slope - truth;
  EXPECT_LT(error.norm(), 0.12) << view.plane.slope.transpose();
  EXPECT_LT(view.plane.slope_cov.trace(), 0.1 * 0.98);
  EXPECT_LT(error.dot(view.plane.slope_cov.inverse() * error), 13.8);  // 99.9 % of chi-square with 2
}

TEST_P(PatchPlanes, TeachNothingFromTheViewTheyWereSeenIn) {
  const CameraState first = on_arc(0, Eigen::Vector3d::UnitY());
  update_patch_plane(view.plane, evidence(wall.seen_from(first, camera), first));
  EXPECT_LT(view.plane.slope.norm(), 0.02);
  EXPECT_GT(view.plane.slope_cov.trace(), 0.95 * 0.98);
}

TEST_P(PatchPlanes, AssumedWrongShiftTheMatchAsPredicted) {
  view.plane.slope = truth + Eigen::Vector2d(0.3, -0.2);
  const CameraState from = on_arc(0.3, Eigen::Vector3d(1, 1, 0).normalized());
  const Image image = wall.seen_from(from, camera);
  SummedImage summed;
  summed.assign(image);
  CorrelationSheet sheet;
  const auto place = [&](const Eigen::Vector2d& slope) {
    const PatchTemplate patch = expected(slope, from);
    return search(sheet, summed, patch, {pixel, 4 * Eigen::Matrix2d::Identity(), 3}, 10)->pixel;
  };
  const Eigen::Vector2d shift = place(view.plane.slope) - place(truth);
  const Eigen::Vector2d predicted = evidence(image, from).shift_per_slope * (truth - view.plane.slope);
  // To first order, and each of the two peaks is fitted to about 0.05 px
  EXPECT_LT((shift - predicted).norm(), 0.3 * predicted.norm() + 0.1)
      << shift.transpose() << " but predicted " << predicted.transpose();
  EXPECT_GT(predicted.norm(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(tilts, PatchPlanes,
                         ::testing::Values(std::pair{0.0, 0.0}, std::pair{0.5, 0.0}, std::pair{0.0, -0.5},
                                           std::pair{-0.6, 0.4}, std::pair{0.9, 0.2}));

/// A blurred dark quarter plane, seen through `map` from view to texture, its corner in the middle.
Image quarter_plane(const Eigen::Matrix2d& map) {
  Image image(61, 61);
  const auto smooth = [](double x) { return 1 / (1 + std::exp(-2.5 * x)); };
  for (int v = 0; v < 61; ++v)
    for (int u = 0; u < 61; ++u) {
      const Eigen::Vector2d at = map * Eigen::Vector2d(u - 30, v - 30);
      image(u, v) =
          static_cast<std::uint8_t>(std::lround(220 - 180 * smooth(at.x() + 2) * smooth(at.y() - 1)));
    }
  return image;
}

// A corner beside the centre: its gradients all point the same way, so much of them is a common grey and
// contrast, which correlation does not see.
TEST(PlaneEvidence, PredictsTheShiftOfACorner) {
  const PatchTexture texture{quarter_plane(Eigen::Matrix2d::Identity()), {30, 30}};
  const auto map = [](double a, double b) {
    return Eigen::Matrix2d((Eigen::Matrix2d() << 1 + a, 0.5 * b, 0.3 * a, 1 + b).finished());
  };
  const auto warped = [&](double a, double b) { return *warp(texture, map(a, b), patch_size_px); };
  for (const Eigen::Vector2d& wrong :
       {Eigen::Vector2d(0.2, 0), Eigen::Vector2d(0, 0.2), Eigen::Vector2d(-0.15, 0.1)}) {
    const Image image = quarter_plane(map(wrong.x(), wrong.y()));
    const Eigen::Vector2d middle(30, 30);
    const auto evidence =
        plane_evidence(image, middle, warped(0, 0), {warped(0.02, 0), warped(0, 0.02)}, 0.02);
    ASSERT_TRUE(evidence);
    SummedImage summed;
    summed.assign(image);
    CorrelationSheet sheet;
    const auto found = search(sheet, summed, warped(0, 0), {middle, 4 * Eigen::Matrix2d::Identity(), 3}, 10);
    const Eigen::Vector2d shift = found->pixel - middle, predicted = evidence->shift_per_slope * wrong;
    EXPECT_LT((shift - predicted).norm(), 0.25 * shift.norm() + 0.05)
        << shift.transpose() << " but predicted " << predicted.transpose();
  }
}

}  // namespace
}  // namespace incognita
