// Symmetries by their definition: invisible to measurements, preserved by motions, removed by anchors.
#include "incognita/analysis/observability/symmetries.hpp"

#include <gtest/gtest.h>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/planar_frame.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;
using Form = SpatialScene::Landmark::Form;

CameraState some_camera(RandomStream& random) {
  CameraState x;
  for (double& number : x) number = random.uniform(-1, 1);
  x.segment<4>(3).normalize();
  return x;
}

Eigen::Vector3d in_front(const CameraState& x, RandomStream& random) {
  const Eigen::Vector3d c(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(1, 4));
  return rotation_matrix<double>(free_camera::orientation(x)) * c + free_camera::position(x);
}

TEST(Symmetries, RangesAndBearingsAreInvariant) {
  RandomStream random(1, "symmetries");
  for (int i = 0; i < 20; ++i) {
    PlanarScene scene;
    scene.vehicles[0] = planar::Pose<double>(random.normal(), random.normal(), random.normal());
    scene.landmarks = {{0, 3, {random.normal(), random.normal()}}};
    scene.errors = 5;
    const auto prediction = RangeBearing::predict_measurement(scene.vehicles[0], scene.landmarks[0].position);
    MatrixXd H(2, 5);
    H << prediction->Hv, prediction->Hl;
    const MatrixXd N = symmetry_directions(scene, {random.normal(), random.normal()});
    EXPECT_LT((H * N).norm(), 1e-12 * (1 + H.norm()));
    // Any rigid motion from one pose to another
    PlanarScene later = scene;
    later.vehicles[0] += planar::Pose<double>(random.normal(), random.normal(), random.normal());
    const MatrixXd F = planar::jacobian_between(scene.vehicles[0], later.vehicles[0]);
    EXPECT_LT(
        (F * symmetry_directions(scene, {1, 2}).topRows(3) - symmetry_directions(later, {1, 2}).topRows(3))
            .norm(),
        1e-12);
  }
}

TEST(Symmetries, PixelsAreInvariantForAnyParametrization) {
  RandomStream random(2, "symmetries");
  const Camera camera = WideAngleCamera{};
  int inverse_depths = 0;
  for (int i = 0; i < 40; ++i) {
    SpatialScene scene;
    scene.camera = some_camera(random);
    scene.errors = 21;
    SpatialScene::Landmark point, inverse;
    point.first = 12;
    point.mean.head<3>() = in_front(scene.camera, random);
    inverse.first = 15;
    inverse.form = Form::inverse_depth;
    const CameraState initialization = some_camera(random);
    inverse.initial_axes.world_from_initial_camera = free_camera::orientation(initialization);
    inverse.mean << free_camera::position(initialization), random.normal(), random.normal(),
        random.uniform(0.1, 1);
    scene.landmarks = {point, inverse};
    const MatrixXd N =
        symmetry_directions(scene, Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
    const auto of_point = PointLandmark::predict_measurement(camera, scene.camera, point.mean.head<3>());
    MatrixXd H = MatrixXd::Zero(2, 21);
    H.leftCols<12>() = of_point->Hv;
    H.middleCols<3>(12) = of_point->Hl;
    EXPECT_LT((H * N).norm(), 1e-11 * (1 + H.norm()));
    const auto of_inverse = inverse.initial_axes.predict_measurement(camera, scene.camera, inverse.mean);
    if (!of_inverse) continue;  // behind the camera
    ++inverse_depths;
    H.setZero();
    H.leftCols<12>() = of_inverse->Hv;
    H.rightCols<6>() = of_inverse->Hl;
    EXPECT_LT((H * N).norm(), 1e-11 * (1 + H.norm()));
  }
  EXPECT_GT(inverse_depths, 5);
}

TEST(Symmetries, InverseDepthLandmarkMovesAsItsPoint) {
  RandomStream random(3, "symmetries");
  for (int i = 0; i < 20; ++i) {
    SpatialScene scene;
    scene.camera = some_camera(random);
    scene.errors = 18;
    SpatialScene::Landmark landmark;
    landmark.first = 12;
    landmark.form = Form::inverse_depth;
    landmark.initial_axes.world_from_initial_camera = free_camera::orientation(scene.camera);
    landmark.mean << free_camera::position(scene.camera), random.normal(), random.normal(),
        random.uniform(0.1, 1);
    scene.landmarks = {landmark};
    const Eigen::Vector3d c(random.normal(), random.normal(), random.normal());
    const auto at = landmark_point(landmark);
    const MatrixXd moved = at->J * symmetry_directions(scene, c).bottomRows(6);
    EXPECT_LT((moved - displacement(at->position, c)).norm(), 1e-10 * (1 + moved.norm()));
  }
}

TEST(Symmetries, FreeCameraMotionPreservesThem) {
  RandomStream random(4, "symmetries");
  for (int i = 0; i < 20; ++i) {
    SpatialScene before, after;
    before.camera = some_camera(random);
    const auto step = FreeCameraMotion{}.step(before.camera, Eigen::Matrix<double, 6, 1>::Zero(), 0.1);
    after.camera = step.x;
    const Eigen::Vector3d c(random.normal(), random.normal(), random.normal());
    EXPECT_LT((step.F * symmetry_directions(before, c) - symmetry_directions(after, c)).norm(), 1e-12);
  }
}

TEST(Symmetries, AnchorsRemoveThem) {
  MatrixXd points(3, 4);
  points << 0, 1, 2, 0,  //
      0, 0, 0, 1,        //
      1, 1, 1, 2;
  const int left[] = {7, 4, 1, 1, 0};  // the first three are collinear
  for (int n = 0; n <= 4; ++n) {
    const RemainingSymmetries remaining = remaining_symmetries(points.leftCols(n));
    EXPECT_EQ(remaining.basis.cols(), left[n]) << n;
    for (int i = 0; i < n; ++i)
      EXPECT_LT((displacement(points.col(i), remaining.about) * remaining.basis).norm(), 1e-12) << n;
  }
  const int left_on_plane[] = {3, 1, 0};
  for (int n = 0; n <= 2; ++n)
    EXPECT_EQ(remaining_symmetries(points.topLeftCorner(2, n)).basis.cols(), left_on_plane[n]) << n;
  EXPECT_EQ(remaining_symmetries(Eigen::Vector2d(3, 4).replicate(1, 3)).basis.cols(),
            1);  // three anchors at one point
}

TEST(Symmetries, CollinearityIsIndependentOfTheOrigin) {
  MatrixXd far(3, 3);
  far << 1000, 1001, 1002, 2000, 2000, 2000, 0, 0, 1e-4;  // 0.05 mm off a line 2 m long
  EXPECT_EQ(remaining_symmetries(far).basis.cols(), 1);
  far(2, 2) = 0.1;
  EXPECT_EQ(remaining_symmetries(far).basis.cols(), 0);
}

}  // namespace
}  // namespace incognita
