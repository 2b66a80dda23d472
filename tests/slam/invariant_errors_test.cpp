// Corrections say nothing about a turn of the whole world, which images do not show.
#include "incognita/slam/mapper/invariant_errors.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numbers>

#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/slam/mapper/correction.hpp"
#include "incognita/slam/mapper/landmarks.hpp"
#include "tests/slam/scene_with_target.hpp"

namespace incognita {
namespace {

using namespace synthetic;
using Turn = Eigen::Matrix<double, Eigen::Dynamic, 3>;

InverseDepthLandmark::State turned(const InverseDepthLandmark& axes, InverseDepthLandmark::State y,
                                   const Eigen::Vector3d& turn) {
  const Eigen::Matrix3d R = rotation_matrix<double>(quaternion_exp<double>(turn));
  const Eigen::Matrix3d A = rotation_matrix<double>(axes.world_from_initial_camera);
  const Eigen::Vector3d ray = A.transpose() * R * A * Eigen::Vector3d(y[3], y[4], 1);
  y.head<3>() = (R * y.head<3>()).eval();
  y.segment<2>(3) = ray.head<2>() / ray.z();
  y[5] /= ray.z();
  return y;
}

TEST(InvariantErrors, DerivativesByATurnOfTheWorldAreThoseOfDifferences) {
  RandomStream random(1, "landmarks");
  for (int k = 0; k < 20; ++k) {
    const InverseDepthLandmark axes{
        quaternion_exp<double>(Vector3<double>(random.normal(), random.normal(), random.normal()))};
    InverseDepthLandmark::State y;
    for (int i = 0; i < 5; ++i) y[i] = random.normal();
    y[5] = k == 0 ? 1e-9 : random.uniform(0.01, 3);  // at infinity too
    const auto numeric =
        numeric_jacobian(3, 1e-6, [&](const Eigen::VectorXd& t) { return turned(axes, y, t); });
    EXPECT_LT((axes.by_world_turn(y) - numeric).cwiseAbs().maxCoeff(), 1e-7);
    const Eigen::Vector3d point = y.head<3>();
    const auto of_point = numeric_jacobian(3, 1e-6, [&](const Eigen::VectorXd& t) -> Eigen::VectorXd {
      return rotation_matrix<double>(quaternion_exp<double>(Eigen::Vector3d(t))) * point;
    });
    EXPECT_LT((PointLandmark::by_world_turn(point) - of_point).cwiseAbs().maxCoeff(), 1e-8);
  }
}

/// A camera that passes landmarks of unknown depth, and a filter that is not sure where the world is turned to.
struct Passing {
  static constexpr double sigma_pixel_px = 0.1;
  EstimatorSettings settings;
  CameraSlamSettings slam = few_features();
  CameraState truth = camera_at({0.3, -0.2, 0.1});
  Estimate estimate;
  std::vector<Eigen::Vector3d> points;
  RandomStream random{7, "passing"};

  explicit Passing(Linearization linearization) {
    settings.filter.linearization = linearization;
    settings.bodies.push_back(free_camera_body(slam.filter));
    slam.map.max_view_angle_rad = std::numbers::pi;
    slam.map.max_scale = 1e6;
    truth.segment<3>(7) << 0, 0.5, 0.1;
    Eigen::Matrix<double, 12, 1> sigmas;
    sigmas << 0.05, 0.05, 0.05, 0.05, 0.05, 0.05, 0.3, 0.3, 0.3, 0.1, 0.1, 0.1;
    Eigen::Matrix<double, 12, 1> error;
    for (int i = 0; i < 12; ++i) error[i] = sigmas[i] * random.normal();
    estimate = estimate_at(plus(FreeCameraMotion::chart, truth, error),
                           sigmas.cwiseAbs2().asDiagonal().toDenseMatrix());
    for (int k = 0; k < 12; ++k) initialize({60.0 + 20 * k, 40.0 + 140 * (k % 3) / 2});
    note();
  }
  void note() {
    if (settings.filter.linearization == Linearization::invariant) begin_invariant_errors(estimate);
  }
  CameraState camera_mean() const { return estimate.belief.mean(estimate.body().block); }
  double pixel_noise() { return sigma_pixel_px * random.normal(); }

  void initialize(const Eigen::Vector2d& pixel) {
    const Eigen::Vector3d ray =
        rotation_matrix<double>(free_camera::orientation(truth)) * *camera.unproject(pixel);
    points.push_back(free_camera::position(truth) + random.uniform(1.5, 4) * ray);
    const Eigen::Vector2d seen = pixel + Eigen::Vector2d(pixel_noise(), pixel_noise());
    const auto made = InverseDepthLandmark::initialize(camera, camera_mean(), seen, 0.5);
    Landmark landmark;
    landmark.id = static_cast<std::int64_t>(points.size()) - 1;
    landmark.camera = 0;
    landmark.form = {LandmarkParametrization::Kind::inverse_depth, made->world_from_initial_camera};
    landmark.first_view = free_camera::position(camera_mean());
    Eigen::Matrix<double, 6, 6> noise = sigma_pixel_px * sigma_pixel_px * made->Jz * made->Jz.transpose();
    noise(5, 5) += 0.25 * 0.25;
    noise.diagonal().head<3>().array() += 1e-8;
    add_landmark(estimate, landmark,
                 {InverseDepthLandmark::chart, made->landmark, estimate.body().block, made->Jv, noise});
  }

  void step(double dt) {
    const FreeCameraMotion model;
    FreeCameraMotion::Input<double> push;
    for (int i = 0; i < 6; ++i) push[i] = (i < 3 ? 0.5 : 0.2) * random.normal();
    truth = model.step(truth, push, dt).x;
    const FreeCameraMotion::Step predicted =
        model.step(camera_mean(), FreeCameraMotion::Input<double>::Zero(), dt);
    Eigen::Matrix<double, 6, 1> var = Eigen::Matrix<double, 6, 1>::Constant(0.25);
    var.tail<3>().setConstant(0.04);
    estimate.belief.predict({estimate.body().block, predicted.x, predicted.F,
                             predicted.G * var.asDiagonal() * predicted.G.transpose()});
    std::vector<LinearizedMeasurement> measurements;
    for (const auto& [id, landmark] : estimate.landmarks) {
      const auto match = predict_pixel(landmark, estimate.belief, camera, camera_mean(), slam);
      const auto seen =
          camera.project(PointLandmark::in_camera<double>(truth, points[static_cast<std::size_t>(id)]));
      if (!match || !seen) continue;
      LinearizedMeasurement& m = measurements.emplace_back();
      m.add(estimate.body().block, match->Hv);
      m.add(landmark.block, match->Hl);
      m.residual = seen->pixel + Eigen::Vector2d(pixel_noise(), pixel_noise()) - match->predicted;
      m.R = sigma_pixel_px * sigma_pixel_px * Eigen::Matrix2d::Identity();
    }
    const auto none = [](const AnyBelief&) { return std::vector<LinearizedMeasurement>{}; };
    ASSERT_TRUE(correct(estimate, measurements, none, settings));
    note();
  }

  /// The direction of a turn in the errors of the belief.
  Turn turn() const {
    Turn N(estimate.belief.errors(), 3);
    const CameraState x = camera_mean();
    N.setZero();
    N.topRows<3>() = -skew<double>(x.head<3>());
    N.middleRows<3>(3) = rotation_matrix<double>(free_camera::orientation(x)).transpose();
    N.middleRows<3>(6) = -skew<double>(x.segment<3>(7));
    for (const auto& [id, landmark] : estimate.landmarks) {
      const SmallVector mean = estimate.belief.mean(landmark.block);
      const ByTurn by_turn = mean.size() == 3 ? ByTurn(PointLandmark::by_world_turn(mean))
                                              : ByTurn(axes_of(landmark).by_world_turn(mean));
      N.middleRows(estimate.belief.offset(landmark.block), by_turn.rows()) = by_turn;
    }
    return N;
  }
  /// Information about it, 1/rad^2.
  Eigen::Matrix3d information() const {
    const Eigen::MatrixXd P = estimate.belief.dense_covariance();
    return turn().transpose() * P.ldlt().solve(turn());
  }
};

/// The largest factor by which the information about any turn grew.
double growth(Linearization linearization, int frames) {
  Passing passing(linearization);
  const Eigen::Matrix3d before = passing.information();
  for (int k = 0; k < frames; ++k) passing.step(0.1);
  const Eigen::Matrix3d L = Eigen::Matrix3d(before.llt().matrixL());
  const Eigen::Matrix3d whitened = L.triangularView<Eigen::Lower>().solve(passing.information());
  const Eigen::Matrix3d ratio = L.triangularView<Eigen::Lower>().solve(whitened.transpose());
  return ratio.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff();
}

TEST(InvariantErrors, MeasurementsGiveNoInformationAboutATurnOfTheWorld) {
  EXPECT_LT(growth(Linearization::invariant, 20), 1 + 1e-3);
  EXPECT_GT(growth(Linearization::analytic, 20), 2)
      << "the extended Kalman filter takes it from its own corrections";
}

/// A landmark that becomes a point keeps its part of the turn.
TEST(InvariantErrors, ConversionToAPointGivesNoInformationEither) {
  Passing passing(Linearization::invariant);
  const Eigen::Matrix3d before = passing.information();
  for (int k = 0; k < 10; ++k) passing.step(0.1);
  for (auto& [id, landmark] : passing.estimate.landmarks) {
    const auto point = axes_of(landmark).point(passing.estimate.belief.mean(landmark.block));
    convert_to_point(passing.estimate.belief, landmark, point.position, point.J, SmallMatrix::Zero(3, 3));
  }
  for (int k = 0; k < 10; ++k) passing.step(0.1);
  EXPECT_LT(passing.information().trace(), 1.02 * before.trace());
}

TEST(InvariantErrors, AreRefusedWhereTheyAreNotDerived) {
  EstimatorSettings settings;
  settings.filter.linearization = Linearization::invariant;
  settings.bodies.push_back(free_camera_body({}));
  EXPECT_EQ(validate(settings), "");
  settings.filter.form = BeliefForm::information;
  EXPECT_NE(validate(settings), "");
  settings.filter.form = BeliefForm::covariance;
  settings.filter.decorrelate = Decorrelation::map_linear;
  EXPECT_NE(validate(settings), "");
  settings.filter.decorrelate = Decorrelation::nothing;
  settings.bodies.push_back(free_camera_body({}));
  EXPECT_NE(validate(settings), "");
  CameraSlamSettings slam = few_features();
  EXPECT_THROW(single_camera(camera, {}, slam, 10, 1, {}, {.linearization = Linearization::invariant}),
               std::invalid_argument)
      << "the camera does not know";
  slam.filter.invariant = true;
  slam.initialization.method = InitializationSettings::Method::depth_line;
  EXPECT_THROW(single_camera(camera, {}, slam, 10, 1), std::invalid_argument);
}

/// Landmarks of the first image, those of later ones, and points that they become.
TEST(InvariantErrors, BeginWithTheFirstImage) {
  CameraSlamSettings slam = few_features();
  slam.filter.invariant = true;
  SlamEstimator estimator = single_camera(camera, sheet_target(), slam, 10, 1);
  const Wall wall = wall_with_sheet();
  Estimate estimate;
  for (int k = 0; k < 30; ++k) {
    estimator.update(estimate, {}, seeing(wall.shared_view(camera_at({0, 0.02 * k, 0}))), tick(k));
    ASSERT_EQ(estimate.status.state, TrackingState::tracking) << estimate.status.reason;
    int mapped = 0;
    for (const auto& [id, landmark] : estimate.landmarks) {
      if (!landmark.mapped()) continue;
      ++mapped;
      ASSERT_EQ(landmark.by_turn.rows(), estimate.belief.chart(landmark.block).tangent()) << "frame " << k;
    }
    ASSERT_GT(mapped, 0);
  }
}

}  // namespace
}  // namespace incognita
