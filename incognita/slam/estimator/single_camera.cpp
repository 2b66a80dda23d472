#include "incognita/slam/estimator/single_camera.hpp"

#include "incognita/slam/features/validation.hpp"

namespace incognita {

BodyModel free_camera_body(const FilterSettings& s) {
  constexpr double sigma_origin = 1e-4;  // m and rad: the origin is where it is by definition
  const Eigen::Matrix3d world_from_camera = (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();
  CameraState start = CameraState::Zero();
  start.segment<4>(3) = quaternion_from_matrix(world_from_camera);
  BodyModel body;
  body.motion = FreeCameraMotion{};
  body.start = start;
  body.start_sigmas = SmallVector::Constant(FreeCameraMotion::error_size, sigma_origin);
  body.start_sigmas.segment<3>(6).setConstant(s.sigma_start_velocity_m_s);
  body.start_sigmas.tail<3>().setConstant(s.sigma_start_angular_rate_rad_s);
  body.input_sigmas = SmallVector::Constant(FreeCameraMotion::input_size, s.sigma_acceleration_m_s2);
  body.input_sigmas.tail<3>().setConstant(s.sigma_angular_acceleration_rad_s2);
  body.input = BodyModel::Input::commanded;
  return body;
}

SlamEstimator single_camera(Camera camera, const std::optional<Target>& target,
                            const CameraSlamSettings& settings, double max_search_s, std::uint64_t seed,
                            const std::optional<WheelOdometry>& odometry, const MapperSettings& filter) {
  std::vector<FeatureTracker> cameras;
  cameras.emplace_back(std::move(camera), settings,
                       CameraPlacement{.target = target, .max_search_s = max_search_s}, seed);
  if (odometry) validate(*odometry);
  EstimatorSettings estimator;
  estimator.filter = filter;
  if (settings.filter.invariant) estimator.filter.linearization = Linearization::invariant;
  estimator.bodies.push_back(free_camera_body(settings.filter));
  estimator.bodies.front().wheels = odometry;
  estimator.health = settings.health;
  return SlamEstimator(std::move(estimator), std::move(cameras));
}

}  // namespace incognita
