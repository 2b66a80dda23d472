// What a team estimator is made of: a motion model and a sensor for each vehicle, noises, and what is known
// before.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "incognita/math/small_matrix.hpp"
#include "incognita/models/any_sensor.hpp"

namespace incognita {

struct TeamMember {
  AnyMotion motion;
  AnySensor sensor;
  SmallVector start;             ///< state at the first tick
  SmallVector start_sigmas;      ///< one per error
  SmallVector input_sigmas;      ///< of each input, held over one reading or tick
  SmallVector sigmas;            ///< of each number of a measurement
  double sigma_range_ratio = 0;  ///< added to the first of them, times what is measured: of ranges
};

struct TeamFilterSettings {
  std::string form = "covariance";      ///< `covariance` or `information`: the same answers at other costs
  std::string lineariser = "analytic";  ///< `analytic`, `iterated`, `unscented-vehicle`, `first-estimate`
  double gate_probability = 1;        ///< of a right sighting; what lies outside is left out. 1: all is used
  double inverse_depth_per_m = 0.25;  ///< of a landmark seen in a direction only, before anything is known
  double sigma_inverse_depth_per_m = 0.25;
  double max_linearity_index = 0.02;  ///< below, an inverse depth becomes a point; 0.1 does for one look, a
                                      ///< map keeps what is left of each
  double max_sigma_position_m = 10;   ///< of any vehicle; beyond, the team is lost
};

/// Which landmark a sighting is of.
struct TeamAssociationSettings {
  std::string method = "known";       ///< `known`: by its name; `nearest`: names of anchors alone are read
  double gate_probability = 0.95;     ///< `nearest`: of a right pairing
  double birth_probability = 0.9999;  ///< `nearest`: outside this gate of every landmark is a new one
};

struct TeamSettings {
  std::vector<TeamMember> members;
  TeamFilterSettings filter;
  std::map<std::int64_t, SmallVector> anchors;  ///< known landmarks: a whole map, or those that fix the frame
  TeamAssociationSettings association = {};
};

}  // namespace incognita
