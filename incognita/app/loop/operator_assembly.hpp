// The operator of a scenario.
#pragma once

#include <cstddef>

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/world/operator_model.hpp"

namespace incognita {

/// Who holds that camera, and how a hand moves it: as the controller would from the true state.
OperatorActuator operator_of(const Scenario& scenario, std::size_t camera);

}  // namespace incognita
