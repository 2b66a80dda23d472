#include "incognita/slam/points/planar_settings.hpp"

namespace incognita {

double& VehicleSettings::parameter(const std::string& key, double default_value) {
  if (key == "wheelbase_m") return wheelbase_m;
  if (key == "wheel_left_m") return wheel_left_m;
  if (key == "sensor_forward_m") return sensor_forward_m;
  if (key == "sensor_left_m") return sensor_left_m;
  return parameters.emplace(key, default_value).first->second;
}

AnyMotion motion_of(const VehicleSettings& settings) {
  AnyMotion motion = make_motion(settings.model);
  VehicleSettings values = settings;
  set_model_parameters(motion,
                       [&](const std::string& key, double usual) { return values.parameter(key, usual); });
  return motion;
}

SmallVector input_sigmas_of(const VehicleSettings& s, const MotionTraits& motion) {
  return values_of(motion.input, {{"speed_m_s", s.sigma_speed_m_s},
                                  {"turn_rate_rad_s", s.sigma_turn_rate_rad_s},
                                  {"steering_rad", s.sigma_steering_rad}});
}

}  // namespace incognita
