// Checks that the settings of a scenario are consistent with each other.
#pragma once

#include <string>
#include <vector>

#include "incognita/io/scenario/scenario.hpp"

namespace incognita {

struct Contradiction {
  std::string key;  ///< the setting to look at first
  std::string why;  ///< "must be ..."
};

/// Empty if the scenario is consistent.
std::vector<Contradiction> find_contradictions(const Scenario& scenario);

}  // namespace incognita
