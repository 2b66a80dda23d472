// The settings of the choice of the next move.
#pragma once

#include <vector>

#include "incognita/decision/settings.hpp"
#include "incognita/io/scenario/setting.hpp"

namespace incognita {

/// Appends every setting of both, which must outlive the list.
void list_decision_settings(std::vector<Setting>& list, DecisionSettings& decision,
                            ExplorationSettings& exploration);

}  // namespace incognita
