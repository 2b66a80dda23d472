// Whether the settings of the choice of the next move fit together.
#pragma once

#include "incognita/io/scenario/scenario_checks.hpp"

namespace incognita {

void check_decision(const Scenario& scenario, std::vector<Contradiction>& found);

}  // namespace incognita
