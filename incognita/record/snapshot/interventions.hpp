// Interventions as text: the messages of a viewer, and the rows of interventions.jsonl.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "incognita/messages/intervention.hpp"

namespace incognita {

/// "cover-lens", "push", ...
const char* name(const Intervention& intervention);

/// One JSON object on one line, e.g. {"type":"displace","body":1,"by_m":[0.5,0,0],"turn_rad":0}; bodies count from 1.
std::string intervention_json(const Intervention& intervention);

/// Throws InputError that names the field, its value and what is allowed; unknown fields are errors.
Intervention intervention_from_json(std::string_view json);

/// An intervention with the tick before whose motion it took effect.
struct LoggedIntervention {
  std::int64_t frame = 0;
  Intervention intervention;
};

/// A row of interventions.jsonl: {"frame":41,"t":1.366667,"intervention":{...}}.
std::string log_row(std::int64_t frame, double t, const Intervention& intervention);
/// Throws InputError as intervention_from_json().
LoggedIntervention from_log_row(std::string_view row);

}  // namespace incognita
