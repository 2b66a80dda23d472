// Bodies in the belief: at the start, in the world after each tick, and put to rest where they were lost.
#pragma once

#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

/// An empty belief of the form that the settings ask for.
AnyBelief empty_belief(const MapperSettings& settings);

/// Adds a body with covariance `P` of its start and, for a map in its frame, the pose of the world relative to it.
/// `t`: s, time of the start.
void add_body(Estimate& estimate, const BodyModel& model, const SmallVector& start, const SmallMatrix& P,
              double t, bool in_vehicle_frame);

/// Stops a body at its last pose and adds the uncertainty of a short search around it.
void stop_and_search(Estimate& estimate, std::size_t body, const EstimatorSettings& settings);

/// Puts a body at `state`, with covariance `P` and independent of the map: what was estimated of it is forgotten.
void put_body(Estimate& estimate, std::size_t body, const SmallVector& state, const SmallMatrix& P);

/// Sets the state and the pose of each body in the world, with their covariances, from the belief.
void express_in_world(Estimate& estimate, const EstimatorSettings& settings);

/// Removes correlations as the settings ask for, thesis Section 3.3.
void decorrelate(Estimate& estimate, Decorrelation which);

}  // namespace incognita
