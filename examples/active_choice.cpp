// A robot with its own loop asks where to go next: to where its measurements will gain most information.
#include <cmath>
#include <cstdio>
#include <random>

#include "incognita/decision/decision.hpp"
#include "incognita/navigator/navigator.hpp"

int main() {
  using namespace incognita;
  EstimatorSettings settings;
  settings.bodies.push_back(body_with_sensor(DifferentialDrive{}, RangeBearingSensor{},
                                             Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.1, 0.1, 0.1),
                                             Eigen::Vector2d(0.05, 0.05), Eigen::Vector2d(0.2, 0.02)));
  const auto strategy = decide_for(SlamEstimator(settings), {.tick_s = 0.1});
  Navigator navigator{SlamEstimator(settings)};

  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Eigen::Vector3d robot(0, 0, 0);  // what really happens
  for (double t = 0; t < 10; t += 0.1) {
    std::vector<PointDetection> detections;
    for (int post = 0; post < 8; ++post) {
      const Eigen::Vector2d z =
          RangeBearing::h<double>(robot, Eigen::Vector2d(1.5 * post - 4, post % 2 ? 3 : -2));
      detections.push_back({post, z + Eigen::Vector2d(0.2 * normal(random), 0.02 * normal(random))});
    }
    navigator.add_detections(detections, t);
    const BodyGoal goal = navigator.choose(*strategy).bodies.at(0);
    if (goal.decided) std::printf("t = %.1f s: %s\n", t, strategy->actions(0).at(goal.chosen).c_str());
    const auto [pose, covariance] = navigator.pose();
    const Eigen::Vector3d to =
        rotation_matrix<double>(pose.world_from_body).transpose() * (goal.to - pose.position);
    const Eigen::Vector2d drive(std::min(0.5, to.norm()),
                                to.norm() > 0.05 ? std::atan2(to.y(), to.x()) : 0.0);
    navigator.add_odometry(drive, t);
    robot = ArcMotion<DifferentialDrive>{}.f<double>(robot, drive, 0.1);
  }
}
