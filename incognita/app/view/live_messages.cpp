#include "incognita/app/view/live_messages.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "incognita/app/loop/interventions.hpp"
#include "incognita/app/view/settings_json.hpp"
#include "incognita/io/formats/embedded.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/record/mcap/run_message.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_scenario = 1u << 20;

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// The words that a setting of the decision may take; none where bodies follow paths.
Json choices_of(const LoadedScenario& loaded, const std::string& key) {
  const auto found = std::find_if(loaded.settings.begin(), loaded.settings.end(),
                                  [&](const SettingInForce& setting) { return setting.key == key; });
  Json choices = Json::array();
  if (found == loaded.settings.end()) return choices;
  for (const std::string& word : words_of(found->allowed)) choices.push_back(word);
  return choices;
}

Json value_in_force(const LoadedScenario& loaded, const std::string& key) {
  for (const SettingInForce& setting : loaded.settings)
    if (setting.key == key) return Json::parse(setting_json(setting))["value"];
  return nullptr;
}

/// The comment at the beginning of a scenario file, on one line.
std::string first_comment(const std::string& toml) {
  std::istringstream lines(toml);
  std::string comment;
  for (std::string line; std::getline(lines, line) && line.starts_with("# ");)
    comment += (comment.empty() ? "" : " ") + line.substr(2);
  return comment;
}

/// Other interventions are over at once, or snapshots tell what they do.
bool stays_in_force(const Intervention& intervention) {
  return std::holds_alternative<CoverLens>(intervention) ||
         std::holds_alternative<AddImageNoise>(intervention) ||
         std::holds_alternative<ChangeLight>(intervention) ||
         std::holds_alternative<ChangeDecision>(intervention);
}

struct Noted {
  Json& info;
  void operator()(const CoverLens& i) const { info["disturbed"]["covered"] = i.covered; }
  void operator()(const AddImageNoise& i) const { info["disturbed"]["sigma_gray"] = i.sigma_gray; }
  void operator()(const ChangeLight& i) const { info["disturbed"]["factor"] = i.factor; }
  void operator()(const ChangeDecision& i) const {
    for (const std::string& setting : i.settings)
      for (const std::string key : {"strategy", "gaze"}) {
        const std::string assignment = "decision." + key + "=";
        if (setting.starts_with(assignment)) info[key] = setting.substr(assignment.size());
      }
  }
  void operator()(const auto&) const {}
};

}  // namespace

std::string live_info_json(const LoadedScenario& loaded, const RunInfo& info, std::int64_t frames) {
  Json json = Json::parse(run_message(info));
  json["name"] = loaded.name;
  json["start_scenario"] = is_embedded(loaded.file) ? loaded.file.stem().string() : loaded.file.string();
  json["expected_frames"] = frames;
  json["effective_toml"] = info.effective_toml;
  if (const Scenario& s = loaded.scenario; s.is_live())
    json["live_camera"] = {
        {"source", s.live.source}, {"width", s.camera.width_px}, {"height", s.camera.height_px}};
  json["disturbances"] = possible_disturbances(loaded.scenario);
  json["disturbed"] = {{"covered", false}, {"sigma_gray", 0}, {"factor", 1}};
  json["manual"] = can_be_taken_over(loaded.scenario);
  json["strategies"] = choices_of(loaded, "decision.strategy");
  json["gazes"] = choices_of(loaded, "decision.gaze");
  json["strategy"] = value_in_force(loaded, "decision.strategy");
  json["gaze"] = value_in_force(loaded, "decision.gaze");
  return text_of(json);
}

std::optional<std::string> changed_info_json(const std::string& info_json,
                                             const std::vector<Intervention>& interventions) {
  if (std::none_of(interventions.begin(), interventions.end(), stays_in_force)) return std::nullopt;
  Json json = Json::parse(info_json);
  for (const Intervention& intervention : interventions) std::visit(Noted{json}, intervention);
  return text_of(json);
}

std::string observability_fields(const ObservabilityReport& report) {
  Json json{{"lines", in_words(report)}};
  Json& directions = json["directions"] = Json::array();
  for (const QuantityReport& quantity : report.quantities) {
    Json direction{
        {"name", quantity.name},
        {"unit", quantity.unit},
        {"observable", quantity.ideally_observable},
        {"overconfident", quantity.gained && !quantity.ideally_observable && !quantity.by_motion_model}};
    if (quantity.estimated_sigma) direction["sigma"] = *quantity.estimated_sigma;
    directions.push_back(std::move(direction));
  }
  const std::string text = text_of(json);
  return text.substr(1, text.size() - 2);
}

std::string scenarios_json(const std::string& further) {
  Json list = Json::array();
  for (const std::string& name : embedded_scenarios()) {
    const std::string path = std::string(embedded_root) + "/" + name + ".toml";
    list.push_back({{"name", name}, {"about", first_comment(read_file(path, largest_scenario))}});
  }
  const auto is_further = [&](const Json& known) { return known["name"] == further; };
  if (std::none_of(list.begin(), list.end(), is_further) && file_exists(further))
    list.push_back({{"name", further}, {"about", first_comment(read_file(further, largest_scenario))}});
  return text_of(list);
}

}  // namespace incognita
