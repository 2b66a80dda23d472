#include "incognita/app/loop/operator_assembly.hpp"

#include <string>

#include "incognita/control/fly_segment.hpp"

namespace incognita {

OperatorActuator operator_of(const Scenario& s, std::size_t camera) {
  const auto seed = static_cast<std::uint64_t>(s.run.seed);
  const OperatorMotion motion = [settings = s.control](const CameraState& state, const Segment& segment,
                                                       const Heading& gaze, double t) {
    return fly_segment(state, segment, gaze, t, settings);
  };
  return {OperatorModel(s.operator_settings, seed, "person." + std::to_string(camera)),
          motion,
          {s.control.gaze_amplitude_rad, s.control.gaze_period_s}};
}

}  // namespace incognita
