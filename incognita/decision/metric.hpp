// Metric of an action.
#pragma once

namespace incognita {

/// What the information of the measurements along the path is about: the full state; position and map,
/// without attitude and velocities (thesis 6.3.2); only the vehicle, once the map is fully correlated (end of
/// 6.1.1); the Fisher trace of (6.8), and the same with R in place of S.
enum class Metric { state, position_and_map, vehicle, fisher, fisher_given_state };

/// Whether the metric is defined for a sequence of several actions.
constexpr bool is_of_sequences(Metric metric) {
  switch (metric) {
    case Metric::state:
    case Metric::vehicle:
      return true;
    case Metric::position_and_map:
    case Metric::fisher:
    case Metric::fisher_given_state:
      return false;
  }
  return false;
}

}  // namespace incognita
