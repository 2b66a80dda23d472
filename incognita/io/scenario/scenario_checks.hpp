// Checks that the values of a scenario fit each other. Which settings there are is checked by their tree.
#pragma once

#include <string>
#include <vector>

#include "incognita/io/scenario/scenario.hpp"

namespace incognita {

struct Contradiction {
  std::string key;  ///< the setting to look at first; one that the scenario has
  std::string why;  ///< "must be ..."
};

/// Empty if the scenario is consistent.
std::vector<Contradiction> find_contradictions(const Scenario& scenario);

/// Parts of it: of vehicles with point landmarks, of a vehicle in the rendered room, of a real one, and of decisions.
void check_team(const Scenario& scenario, std::vector<Contradiction>& found);
void check_room_vehicle(const Scenario& scenario, std::vector<Contradiction>& found);
void check_robot(const Scenario& scenario, std::vector<Contradiction>& found);
void check_decision(const Scenario& scenario, std::vector<Contradiction>& found);
void check_camera(const Scenario& scenario, std::vector<Contradiction>& found);

}  // namespace incognita
