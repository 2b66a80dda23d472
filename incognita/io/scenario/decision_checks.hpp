// Checks that the decision settings are consistent.
#pragma once

#include "incognita/io/scenario/scenario_checks.hpp"

namespace incognita {

void check_decision(const Scenario& scenario, std::vector<Contradiction>& found);

}  // namespace incognita
