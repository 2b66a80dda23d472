// Whether the settings of a team's scenario fit together.
#pragma once

#include "incognita/io/scenario/scenario_checks.hpp"

namespace incognita {

void check_team(const Scenario& scenario, std::vector<Contradiction>& found);

/// Of a vehicle in the rendered room: what is not of its camera.
void check_room_vehicle(const Scenario& scenario, std::vector<Contradiction>& found);

/// Of the camera alone.
void check_camera(const Scenario& scenario, std::vector<Contradiction>& found);

}  // namespace incognita
