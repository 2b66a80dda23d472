// Settings of the rendered room, and of an operator who moves a camera in it or elsewhere.
#pragma once

#include <Eigen/Core>

namespace incognita {

struct RoomSettings {
  Eigen::Vector3d size_m{6.0, 6.0, 2.5};            ///< interior: +-x/2, +-y/2, 0 to z
  int boxes = 6;                                    ///< textured boxes standing on the floor along the walls
  Eigen::Vector3d start_position_m{1.6, 0.0, 1.3};  ///< camera at t = 0, facing the target along +x
  double start_heading_rad = 0.0;                   ///< about z, from +x
  double sigma_start_position_m = 0.05;             ///< spread of the true start about the above
  double sigma_start_heading_rad = 0.03;
  double sigma_image_gray = 2.0;         ///< image noise, gray levels
  double sigma_acceleration_m_s2 = 0.3;  ///< true disturbance per axis, held for one frame
  double sigma_angular_acceleration_rad_s2 = 0.3;
  double clearance_m = 0.15;      ///< minimum distance of the camera from walls and boxes
  double cover_lens_from_s = -1;  ///< time from which the lens is covered; negative: never
};

/// Operator who moves the camera by hand as shown on a screen, thesis 6.3.2.
struct OperatorSettings {
  bool holds = false;            ///< whether an operator holds the camera
  double delay_s = 0.3;          ///< delay from command shown to motion
  double wrong = 0;              ///< probability of moving in another of six directions
  double sigma_way_ratio = 0.2;  ///< sigma of the length moved over the length shown
};

}  // namespace incognita
