// Builds the components of the loop from a team scenario, simulated or recorded.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "incognita/app/loop/loop.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/record/summary/map_survey.hpp"
#include "incognita/slam/mapper/settings.hpp"
#include "incognita/world/points/team_world.hpp"

namespace incognita {

struct TeamAssembly {
  LoopParts parts;
  EstimatorSettings estimator;
  std::vector<std::string> notes;  ///< assumptions, for printing
  /// True identity of each detection, tick by tick, for evaluation; null if the estimator gets the identities.
  std::shared_ptr<const AssociationTruth> association_truth = nullptr;
  Survey survey = {};                      ///< true landmarks if the map has their identities
  std::vector<std::string> warnings = {};  ///< likely problems of a recording
};

/// Throws InputError naming file and key or value, e.g. for a sensor that does not fit the vehicle, or a
/// control law or path that the vehicle cannot follow.
TeamAssembly assemble_team(const LoadedScenario& loaded);

}  // namespace incognita
