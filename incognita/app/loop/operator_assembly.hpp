// Builds the operator model of a scenario.
#pragma once

#include <cstddef>

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/world/operator_model.hpp"

namespace incognita {

/// The operator who holds that camera and moves it by the controller's law, evaluated at the true state.
OperatorActuator operator_of(const Scenario& scenario, std::size_t camera);

}  // namespace incognita
