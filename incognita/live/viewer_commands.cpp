#include "incognita/live/viewer_commands.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/json_limits.hpp"
#include "incognita/record/snapshot/interventions.hpp"

namespace incognita {
namespace {

using Json = nlohmann::json;

constexpr double least_speed = 0.1, most_speed = 100;
constexpr std::size_t most_settings = 500;

std::string text_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string())
    throw InputError(std::string("message: field \"") + key + "\" must be a text");
  return found->get<std::string>();
}

SetSpeed speed_of(const Json& json) {
  const auto found = json.find("factor");
  const double factor = found != json.end() && found->is_number() ? found->get<double>() : -1;
  if (factor != 0 && !(factor >= least_speed && factor <= most_speed))
    throw InputError("speed: factor must be a number from 0.1 to 100, or 0: as fast as possible");
  return {factor};
}

StopRobot stop_robot_of(const Json& json) {
  const auto found = json.find("stopped");
  if (found == json.end() || !found->is_boolean())
    throw InputError("stop-robot: stopped must be true or false");
  return {found->get<bool>()};
}

StartRun start_of(const Json& json) {
  StartRun start{text_of(json, "scenario"), {}};
  const auto set = json.find("set");
  if (set == json.end()) return start;
  const auto is_text = [](const Json& entry) { return entry.is_string(); };
  if (!set->is_array() || set->size() > most_settings || !std::all_of(set->begin(), set->end(), is_text))
    throw InputError("start: set must be a list of at most 500 texts, \"key=value\"");
  start.settings = set->get<std::vector<std::string>>();
  return start;
}

}  // namespace

ViewerCommand viewer_command(std::string_view text) {
  if (json_depth(text) > most_json_depth) throw InputError("message: is nested too deep");
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) throw InputError("message: must be a JSON object");
  const std::string type = text_of(json, "type");
  if (type == "pause") return PauseRun{};
  if (type == "resume") return ResumeRun{};
  if (type == "step") return StepRun{};
  if (type == "speed") return speed_of(json);
  if (type == "stop") return StopRun{};
  if (type == "save") return SaveRun{};
  if (type == "start") return start_of(json);
  if (type == "stop-robot") return stop_robot_of(json);
  if (type != "intervene")
    throw InputError("message: type = \"" + type.substr(0, 80) +
                     "\": must be pause, resume, step, speed, stop, save, start, stop-robot or intervene");
  const auto found = json.find("intervention");
  if (found == json.end()) throw InputError("intervene: field \"intervention\" is missing");
  return intervention_from_json(found->dump(-1, ' ', true, Json::error_handler_t::replace));
}

std::string type_of_message(std::string_view text) {
  if (json_depth(text) > most_json_depth) return "";
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("type") || !json["type"].is_string()) return "";
  std::string type = json["type"].get<std::string>();
  const auto intervention = json.find("intervention");
  if (type == "intervene" && intervention != json.end() && intervention->is_object() &&
      intervention->contains("type") && (*intervention)["type"].is_string())
    type = (*intervention)["type"].get<std::string>();
  return type.substr(0, 40);
}

}  // namespace incognita
