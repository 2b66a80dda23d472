// Evaluation order of a motion's assignments: an input is set before the assignments that use it.
#pragma once

#include <vector>

#include "incognita/analysis/systems/symbolic_system.hpp"

namespace incognita {

/// States before inputs and otherwise in the given order, but every input before the assignments that use it,
/// directly or through definitions. States are set in the order of the file: a later one uses the new values
/// of earlier ones. Throws SystemError, with the location, if inputs depend on themselves.
std::vector<SymbolicSystem::Assignment> in_order_of_evaluation(
    const ExpressionGraph& graph, const std::vector<SymbolicSystem::Assignment>& assignments);

}  // namespace incognita
