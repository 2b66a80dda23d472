// The order in which a motion's assignments are evaluated: an input that another assignment names is set
// before it.
#pragma once

#include <vector>

#include "incognita/analysis/systems/symbolic_system.hpp"

namespace incognita {

/// States before inputs and otherwise as given, but every input before the assignments that name it, directly
/// or through definitions. States are set in the order of the file: a later one sees what an earlier one was
/// set to. Throws SystemError, with the place, where inputs depend on themselves.
std::vector<SymbolicSystem::Assignment> in_order_of_evaluation(
    const ExpressionGraph& graph, const std::vector<SymbolicSystem::Assignment>& assignments);

}  // namespace incognita
