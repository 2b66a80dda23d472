// Maps with the wheels and the scanner of your own robot. Here the robot drives a circle among six posts.
#include <cmath>
#include <cstdio>
#include <random>

#include "incognita/navigator/navigator.hpp"

int main() {
  using namespace incognita;
  EstimatorSettings settings;
  settings.association.method =
      DataAssociationSettings::Method::joint;  // the detections do not say which post they are of
  settings.association.initialization_distance_m = 1;
  settings.bodies.push_back(body_with_sensor(DifferentialDrive{}, RangeBearingSensor{},
                                             /*start=*/Eigen::Vector3d(0, 0, 0),
                                             /*sigmas=*/Eigen::Vector3d(0, 0, 0),
                                             /*of speed and turn rate=*/Eigen::Vector2d(0.1, 0.1),
                                             /*of range and bearing=*/Eigen::Vector2d(0.05, 0.02)));
  Navigator navigator{SlamEstimator(settings)};

  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Eigen::Vector3d robot(0, 0, 0);  // what really happens
  for (double t = 0; t < 30; t += 0.1) {
    navigator.add_odometry({0.5, 0.25}, t);
    std::vector<PointDetection> detections;
    for (int post = 0; post < 6; ++post) {
      const Eigen::Vector2d at(4 * std::cos(post), 2 + 4 * std::sin(post));
      const Eigen::Vector2d z = RangeBearing::h<double>(robot, at);
      detections.push_back(
          {Detection::unknown, z + Eigen::Vector2d(0.05 * normal(random), 0.02 * normal(random))});
    }
    navigator.add_detections(detections, t);
    const Eigen::Vector2d executed(0.5 + 0.1 * normal(random), 0.25 + 0.1 * normal(random));
    robot = ArcMotion<DifferentialDrive>{}.f<double>(robot, executed, 0.1);
  }
  const Eigen::Vector3d error = navigator.pose().pose.position - Eigen::Vector3d(robot.x(), robot.y(), 0);
  std::printf("%zu posts mapped, off by %.2f m\n", navigator.landmarks().size(), error.norm());
}
