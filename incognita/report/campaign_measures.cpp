#include "incognita/report/campaign_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of_item(const Json& item, std::size_t place) {
  if (!item.is_object() || !item.contains("name") || !item["name"].is_string())
    return std::to_string(place + 1);
  std::string name = item["name"];
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string below(const std::string& name, const std::string& part) {
  return name.empty() ? part : fmt::format("{}.{}", name, part);
}

/// Numbers of the consistency verdict that are also measures of their own, and the bands.
bool repeats_another(const std::string& name) {
  for (const char* repeated : {"consistency.nis", "consistency.nis_band", "consistency.nees",
                               "consistency.nees_band", "consistency.overconfident_frames"})
    if (name == repeated) return true;
  return name.starts_with("vehicles.") && name.ends_with(".nees_band");
}

void gather(const Json& value, const std::string& name, Measures& all) {
  if (value.is_number())
    all.emplace_back(name, value.get<double>());
  else if (value.is_null())
    all.emplace_back(name, std::numeric_limits<double>::quiet_NaN());
  else if (value.is_object()) {
    for (const auto& [key, part] : value.items()) {
      const std::string whole = below(name, key);
      if (!repeats_another(whole)) gather(part, whole, all);
    }
  } else if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i)
      gather(value[i], below(name, name_of_item(value[i], i)), all);
}

}  // namespace

RunMeasures measures_of(const std::string& summary_json) {
  const Json summary = Json::parse(summary_json, nullptr, false);
  if (!summary.is_object()) throw std::invalid_argument("summary.json: is not a JSON object");
  Measures all;
  gather(summary, "", all);
  RunMeasures run;
  for (auto& measure : all) {
    if (measure.first == "seed") continue;
    (measure.first.starts_with("timing_ms.") ? run.timings : run.measures).push_back(std::move(measure));
  }
  return run;
}

}  // namespace incognita
