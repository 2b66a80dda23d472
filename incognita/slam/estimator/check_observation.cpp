#include "incognita/slam/estimator/check_observation.hpp"

#include <stdexcept>
#include <string>

#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {
namespace {

void check_detections(const BodyObservation& observed, std::size_t body, const EstimatorSettings& s) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("a detection of body " + std::to_string(body + 1) + why);
  };
  const auto check_sensor = [&](const PointDetection& d) {
    const std::size_t sensors = s.bodies[body].sensors.size();
    if (d.sensor < 0 || static_cast<std::size_t>(d.sensor) >= sensors)
      refuse(" is of its point sensor " + std::to_string(d.sensor + 1) + ", but it has " +
             std::to_string(sensors));
  };
  const bool by_identity = s.association.method == DataAssociationSettings::Method::known;
  for (const PointDetection& d : observed.landmarks) {
    check_sensor(d);
    if (by_identity && d.identity >= first_feature_number)
      refuse(" has the identity " + std::to_string(d.identity) + "; identities must be below " +
             std::to_string(first_feature_number));
  }
  for (const PointDetection& d : observed.vehicles) {
    check_sensor(d);
    if (d.identity < 0 || static_cast<std::size_t>(d.identity) >= s.bodies.size())
      refuse(" is of body " + std::to_string(d.identity + 1) + ", but there are " +
             std::to_string(s.bodies.size()));
  }
}

void check_odometry(const BodyObservation& observed, std::size_t body, const EstimatorSettings& s) {
  for (const Odometry& reading : observed.odometry)
    if (reading.twist && !traits_of(s.bodies[body].motion).is_planar_pose())
      throw std::invalid_argument("an odometry reading of body " + std::to_string(body + 1) +
                                  " is a twist on a plane, and the body does not move on one");
}

}  // namespace

void check_observation(const Observation& observation, const EstimatorSettings& s) {
  if (observation.bodies.empty()) return;
  if (observation.bodies.size() != s.bodies.size())
    throw std::invalid_argument("observations of " + std::to_string(observation.bodies.size()) +
                                " vehicles were given to an estimator of " + std::to_string(s.bodies.size()));
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    check_detections(observation.bodies[i], i, s);
    check_odometry(observation.bodies[i], i, s);
  }
}

}  // namespace incognita
