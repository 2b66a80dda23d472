// Maps with the images of your own camera and prints where it is: own_images IMAGE...
#include <cstdio>

#include "incognita/io/formats/image_file.hpp"
#include "incognita/navigator/navigator.hpp"
#include "incognita/slam/estimator/single_camera.hpp"

int main(int argc, char** argv) {
  using namespace incognita;
  WideAngleCamera lens;  // your calibration: size, focal lengths and principal point in pixels
  lens.width = 320, lens.height = 240, lens.fu = lens.fv = 195, lens.u0 = 159.5, lens.v0 = 119.5;
  CameraSlamSettings settings;
  settings.filter.sigma_acceleration_m_s2 = 1;  // how jerkily the camera is moved
  Navigator navigator(single_camera(lens, std::nullopt, settings, /*max_search_s=*/10, /*seed=*/1));

  for (int i = 1; i < argc; ++i) {
    const Image image = read_image(argv[i]);  // or the buffer that your driver fills
    navigator.add_image({image.row(0), image.width(), image.height(), image.width()}, i / 30.0);
    const auto [pose, covariance] = navigator.pose();
    const Eigen::Vector3d& p = pose.position;
    std::printf("%.3f %.3f %.3f, sigma %.3f, %s: %s\n", p.x(), p.y(), p.z(), std::sqrt(covariance(0, 0)),
                name(navigator.status().state), navigator.status().reason.c_str());
  }
  std::printf("%zu landmarks\n", navigator.landmarks().size());
}
