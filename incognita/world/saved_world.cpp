// The state of clocks, simulated bodies, operators and sensors: what their random streams and motions need to go on.
#include "incognita/messages/saved_messages.hpp"
#include "incognita/world/disturbed_images.hpp"
#include "incognita/world/fixed_rate_clock.hpp"
#include "incognita/world/sensor_set.hpp"
#include "incognita/world/simulated_world.hpp"

namespace incognita {

/// The number of frames follows from the duration, which may be longer after a resumption.
void FixedRateClock::state(StateArchive& archive) {
  auto& [rate_hz, frames, next] = *this;
  archive(next);
}

void Plant::state(StateArchive& archive) {
  auto& [motion, settings, disturbance, state, executed, in_force] = *this;
  archive(disturbance, state, executed, in_force);
  const bool fits = state.size() == settings.start.size() &&
                    executed.size() == settings.input_sigmas.size() && in_force.size() == executed.size();
  if (!fits) throw DamagedState("the state of a body with another motion model");
}

void OperatorModel::state(StateArchive& archive) {
  auto& [settings, random, waiting, in_progress, started] = *this;
  archive(random, waiting, in_progress, started);
}

void OperatorActuator::Moment::state(StateArchive& archive) {
  auto& [camera_, t_] = *this;
  archive(camera_, t_);
}

void OperatorActuator::state(StateArchive& archive) {
  auto& [model, motion, swing, stopped, first_gaze, swing_start_t] = *this;
  archive(model, stopped, first_gaze, swing_start_t);
}

void SimulatedWorld::Simulated::state(StateArchive& archive) {
  auto& [body_, plant_, stopped_, push_m_s_, push_left_s_] = *this;
  if (body_.actuator) archive(*body_.actuator);
  archive(plant_, stopped_, push_m_s_, push_left_s_);
}

void SimulatedWorld::state(StateArchive& archive) {
  auto& [bodies, last_t] = *this;
  archive.each(bodies, "bodies");
  archive(last_t);
}

void SensorSet::state(StateArchive& archive) {
  archive.expect_size(bodies_.size(), "bodies");
  for (BodySensors& sensors : bodies_) {
    archive.expect_size(sensors.size(), "sensors");
    for (const auto& sensor : sensors) sensor->state(archive);
  }
}

void ImageNoise::state(StateArchive& archive) {
  auto& [random, table] = *this;
  archive(random);
}

/// The table of the noise follows from its sigma alone: the stream begins anew with each.
void DisturbedImages::state(StateArchive& archive) {
  auto& [sensors, seed, covered, light, noise, sigma_gray] = *this;
  archive(covered, light, sigma_gray);
  if (archive.restores()) add_noise({sigma_gray});
  if (noise) archive(*noise);
  sensors->state(archive);
}

}  // namespace incognita
