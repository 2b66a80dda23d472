// What an action is worth by.
#pragma once

namespace incognita {

/// What the information of the looks along the path is about: all of the state; without the gaze and the
/// velocities (thesis 6.3.2); the vehicle alone, once the map is fully correlated (end of 6.1.1); the trace
/// of (6.8), and the same with R for S.
enum class Metric { state, position_and_map, vehicle, fisher, fisher_given_state };

}  // namespace incognita
