// What can be set on the rendered room, and on an operator who moves a camera in it or elsewhere.
#pragma once

#include <Eigen/Core>

namespace incognita {

struct RoomSettings {
  Eigen::Vector3d size_m{6.0, 6.0, 2.5};            ///< the room spans +-x/2, +-y/2, and 0 to z
  int boxes = 6;                                    ///< textured boxes standing on the floor along the walls
  Eigen::Vector3d start_position_m{1.6, 0.0, 1.3};  ///< camera at t = 0; it looks along +x, at the target
  double start_heading_rad = 0.0;                   ///< about z, from +x
  double sigma_start_position_m = 0.05;             ///< the true start is drawn around the above
  double sigma_start_heading_rad = 0.03;
  double sigma_image_gray = 2.0;         ///< image noise, grey levels
  double sigma_acceleration_m_s2 = 0.3;  ///< true disturbance per axis, held for one frame
  double sigma_angular_acceleration_rad_s2 = 0.3;
  double clearance_m = 0.15;      ///< the camera's body stops this far from walls and boxes
  double cover_lens_from_s = -1;  ///< the lens is covered from then on; never when negative
};

/// An operator who moves the camera by hand as a screen says, thesis 6.3.2.
struct OperatorSettings {
  bool holds = false;            ///< the camera
  double delay_s = 0.3;          ///< from what is shown to what is done
  double wrong = 0;              ///< probability that another of the six directions is taken, as far
  double sigma_way_ratio = 0.2;  ///< of how far it is moved, over how far was shown
};

}  // namespace incognita
