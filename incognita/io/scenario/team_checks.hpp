// Checks that the settings of a team scenario are consistent.
#pragma once

#include "incognita/io/scenario/scenario_checks.hpp"

namespace incognita {

void check_team(const Scenario& scenario, std::vector<Contradiction>& found);

/// Checks a vehicle in the rendered room, except for its camera.
void check_room_vehicle(const Scenario& scenario, std::vector<Contradiction>& found);

/// Checks the camera only.
void check_camera(const Scenario& scenario, std::vector<Contradiction>& found);

}  // namespace incognita
