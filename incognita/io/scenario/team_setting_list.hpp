// The settings of a team's scenario, and which of all settings mean something to a team.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/io/scenario/setting.hpp"

namespace incognita {

/// Whether many vehicles run in one belief: in a place of points, or as a recording has them.
bool is_team(const Scenario& scenario);

/// Whether a camera is carried by a vehicle that its filter knows nothing of: thesis Section 6.4.
bool has_carried_camera(const Scenario& scenario);

/// Whether a vehicle on uneven ground carries the camera through the rendered room.
bool is_room_vehicle(const Scenario& scenario);

/// Appends every setting of `team`, which must outlive the list.
void list_team_settings(std::vector<Setting>& list, TeamScenario& team);

/// Keys of the true noises, each with that of what the filter believes.
std::vector<std::pair<const char*, const char*>> true_noise_defaults();

/// Whether a section belongs to teams alone.
bool is_team_section(const std::string& section);

/// Whether a section holds the parameters of a sensor.
bool is_of_sensor(const std::string& section);

/// Whether a key of [vehicle] applies to a motion model; one that no model declares applies to all.
bool applies_to_motion(const std::string& key, const std::string& model);

/// With which other setting a key means nothing in a team's scenario; empty where it means something.
std::string inapplicable_to_team(const std::string& key, const Scenario& scenario);
/// Likewise of a vehicle in the rendered room.
std::string inapplicable_to_room_vehicle(const std::string& key, const Scenario& scenario);

}  // namespace incognita
