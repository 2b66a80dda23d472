// Messages in the state of a run.
#pragma once

#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {

template <AnyStateArchive Archive>
void serialize(Archive& archive, Tick& tick) {
  auto& [frame, t, dt, whole_us] = tick;
  archive(frame, t, dt, whole_us);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, Segment& segment) {
  auto& [from, to, start_t, end_t] = segment;
  archive(from, to, start_t, end_t);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, Heading& heading) {
  auto& [rad, rate_rad_s, elevation_rad, elevation_rate_rad_s] = heading;
  archive(rad, rate_rad_s, elevation_rad, elevation_rate_rad_s);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, UserCommand& shown) {
  auto& [segment, is_new, gaze] = shown;
  archive(segment, is_new, gaze);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, BodyCommand& command) {
  auto& [input, operator_controlled, shown, reference] = command;
  archive(input, operator_controlled, shown, reference);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, Command& command) {
  auto& [bodies] = command;
  archive(bodies);
}

}  // namespace incognita
