#include "incognita/slam/points/planar_settings.hpp"

namespace incognita {

AnyMotion motion_of(const VehicleSettings& settings) {
  AnyMotion motion = make_motion(settings.model);
  set_model_parameters(motion,
                       [&](const std::string& key, double usual) { return settings.parameter(key, usual); });
  return motion;
}

SmallVector input_sigmas_of(const VehicleSettings& s, const MotionTraits& motion) {
  return values_of(motion.input, {{"speed_m_s", s.sigma_speed_m_s},
                                  {"turn_rate_rad_s", s.sigma_turn_rate_rad_s},
                                  {"steering_rad", s.sigma_steering_rad}});
}

}  // namespace incognita
