// The settings of the decision.
#pragma once

#include <vector>

#include "incognita/decision/settings.hpp"
#include "incognita/io/scenario/setting.hpp"

namespace incognita {

/// Appends all settings of both structs, which must outlive the list.
void list_decision_settings(std::vector<Setting>& list, DecisionSettings& decision,
                            ExplorationSettings& exploration);

}  // namespace incognita
