// What no single setting can tell: whether the settings of a scenario fit together.
#pragma once

#include <string>
#include <vector>

#include "incognita/io/scenario/scenario.hpp"

namespace incognita {

struct Contradiction {
  std::string key;  ///< where to look first
  std::string why;  ///< "must be ..."
};

/// Empty when all is well.
std::vector<Contradiction> find_contradictions(const Scenario& scenario);

}  // namespace incognita
