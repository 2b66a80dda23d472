// The settings of a team scenario, and the applicability of settings to a team.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/io/scenario/setting.hpp"

namespace incognita {

/// Whether vehicles are estimated in one team belief: with simulated point landmarks, or from a team recording.
bool is_team(const Scenario& scenario);

/// Whether a camera is carried by a vehicle that its filter does not model: thesis Section 6.4.
bool has_carried_camera(const Scenario& scenario);

/// Whether a vehicle on uneven ground carries the camera through the rendered room.
bool is_room_vehicle(const Scenario& scenario);

/// Appends all settings of `team`, which must outlive the list.
void list_team_settings(std::vector<Setting>& list, TeamScenario& team);

/// Keys of the true noises, each with the key of the filter's noise it defaults to.
std::vector<std::pair<const char*, const char*>> true_noise_defaults();

/// Whether a section applies to teams only.
bool is_team_section(const std::string& section);

/// Whether a section holds the parameters of a sensor.
bool is_of_sensor(const std::string& section);

/// Whether a [vehicle] key applies to a motion model; keys that no model declares apply to all.
bool applies_to_motion(const std::string& key, const std::string& model);

/// The setting that makes a key inapplicable to a team scenario; empty if it applies.
std::string inapplicable_to_team(const std::string& key, const Scenario& scenario);
/// The same for a vehicle in the rendered room.
std::string inapplicable_to_room_vehicle(const std::string& key, const Scenario& scenario);

}  // namespace incognita
