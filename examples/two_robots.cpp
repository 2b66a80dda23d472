// Two robots share one map: the first knows where it is, the second learns it from a post that both see.
#include <cstdio>

#include "incognita/navigator/navigator.hpp"

int main() {
  using namespace incognita;
  const auto robot = [](const Eigen::Vector3d& start, double sigma_m) {
    return body_with_sensor(DifferentialDrive{}, RangeBearingSensor{}, start,
                            Eigen::Vector3d(sigma_m, sigma_m, 0.01), Eigen::Vector2d(0.05, 0.05),
                            Eigen::Vector2d(0.05, 0.01));
  };
  EstimatorSettings settings;
  settings.bodies = {robot({0, 0, 0}, 0.01), robot({0, 2, 0}, 1)};
  Navigator navigator{SlamEstimator(settings)};

  const Eigen::Vector2d post(5, 1);
  for (int k = 0; k < 20; ++k) {
    const double t = 0.1 * k;
    for (const std::size_t body : {0u, 1u}) {
      const Eigen::Vector3d truth(0.5 * t, 2.0 * static_cast<double>(body), 0);
      navigator.add_odometry({0.5, 0}, t, body);
      navigator.add_detections({{7, RangeBearing::h<double>(truth, post)}}, t, body);
    }
    if (k % 5 == 0)
      std::printf("t = %.1f s: sigma of the second robot %.2f m\n", t,
                  std::sqrt(navigator.pose(1).covariance.topLeftCorner<2, 2>().trace()));
  }
}
