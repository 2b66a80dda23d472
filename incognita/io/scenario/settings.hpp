// The list that binds every field of a scenario to its key.
#pragma once

#include <string>
#include <vector>

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/io/scenario/setting.hpp"

namespace incognita {

/// All settings, section by section, bound to the fields of `scenario`, which must outlive the list.
std::vector<Setting> list_settings(Scenario& scenario);

/// The settings that apply to this scenario.
std::vector<Setting> settings_in_force(Scenario& scenario);

/// The other setting that makes this one inapplicable, so that it would be ignored: "run.sensor = `camera`".
/// Empty if it applies.
std::string inapplicable_reason(const std::string& key, const Scenario& scenario);

/// "run" of "run.seed".
std::string section_of(const std::string& key);
/// "seed" of "run.seed".
std::string name_in_section(const std::string& key);

}  // namespace incognita
