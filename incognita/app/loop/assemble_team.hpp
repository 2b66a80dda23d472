// From a scenario with vehicles that name what they see, simulated or recorded, to the boxes of the loop.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "incognita/app/loop/loop.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/record/summary/map_survey.hpp"
#include "incognita/world/points/team_world.hpp"

namespace incognita {

struct TeamAssembly {
  TeamBoxes boxes;
  std::vector<std::string> notes;  ///< what was guessed, for printing
  /// What each sighting really is of, tick by tick, for who scores; null where the estimator is told.
  std::shared_ptr<const AssociationTruth> association_truth = nullptr;
  Survey survey = {};                      ///< the true landmarks, where the map has their identities
  std::vector<std::string> warnings = {};  ///< what is most likely wrong with a recording
};

/// Throws InputError naming file and key or value: vehicles that can not carry that sensor, laws that can not
/// steer them, paths that they can not follow.
TeamAssembly assemble_team(const LoadedScenario& loaded);

}  // namespace incognita
