// The one list that binds every field of a scenario to its key.
#pragma once

#include <string>
#include <vector>

#include "incognita/io/scenario.hpp"
#include "incognita/io/setting.hpp"

namespace incognita {

/// Every setting, section by section, bound to the fields of `scenario`, which must outlive the list.
std::vector<Setting> list_settings(Scenario& scenario);

/// Those of them that mean something with the scenario's run.sensor.
std::vector<Setting> settings_in_force(Scenario& scenario);

/// Whether a section means something to the estimator of that run.sensor.
bool means_something(const std::string& section, const std::string& sensor);

/// "run" of "run.seed".
std::string section_of(const std::string& key);
/// "seed" of "run.seed".
std::string name_in_section(const std::string& key);

}  // namespace incognita
