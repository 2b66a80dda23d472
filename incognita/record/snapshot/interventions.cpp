#include "incognita/record/snapshot/interventions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/json_limits.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* names[] = {"cover-lens", "image-noise", "light", "displace", "push",
                                 "take-over",  "give-back",   "drive", "set"};
constexpr double most_m = 1000, most_rad = 6.3, most_m_s = 100, most_s = 60;
constexpr std::size_t most_settings = 50;

Json xyz(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

struct Written {
  Json& json;
  void operator()(const CoverLens& i) { json["covered"] = i.covered; }
  void operator()(const AddImageNoise& i) { json["sigma_gray"] = i.sigma_gray; }
  void operator()(const ChangeLight& i) { json["factor"] = i.factor; }
  void operator()(const DisplaceBody& i) {
    body(i.body), json["by_m"] = xyz(i.by_m), json["turn_rad"] = i.turn_rad;
  }
  void operator()(const PushBody& i) {
    body(i.body), json["velocity_m_s"] = xyz(i.velocity_m_s), json["duration_s"] = i.duration_s;
  }
  void operator()(const TakeOverBody& i) { body(i.body); }
  void operator()(const GiveBackBody& i) { body(i.body); }
  void operator()(const DriveBody& i) {
    body(i.body);
    json["forward"] = i.direction.x(), json["left"] = i.direction.y(), json["up"] = i.direction.z();
    json["turn"] = i.turn;
  }
  void operator()(const ChangeDecision& i) { json["settings"] = i.settings; }
  void body(std::size_t index) { json["body"] = index + 1; }
};

Json json_of(const Intervention& intervention) {
  Json json{{"type", name(intervention)}};
  std::visit(Written{json}, intervention);
  return json;
}

/// The fields of one object; every field must be asked for.
class Fields {
 public:
  explicit Fields(const Json& json) : json_(json) {
    if (!json.is_object()) throw InputError("an intervention must be a JSON object");
  }

  std::string word(const char* key) {
    const Json& value = required(key);
    if (!value.is_string()) wrong(key, value, "a text");
    return value.get<std::string>();
  }
  bool flag(const char* key) {
    const Json& value = required(key);
    if (!value.is_boolean()) wrong(key, value, "true or false");
    return value.get<bool>();
  }
  double number(const char* key, double least, double most) {
    const Json& value = required(key);
    check_number(key, value, least, most);
    return value.get<double>();
  }
  Eigen::Vector3d vector(const char* key, double most) {
    const Json& value = required(key);
    if (!value.is_array() || value.size() != 3) wrong(key, value, "three numbers");
    for (const Json& entry : value) check_number(key, entry, -most, most);
    return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
  }
  std::size_t body() {
    const Json& value = required("body");
    if (!value.is_number_integer() || value < 1 || value > 1000) wrong("body", value, "a number from 1");
    return value.get<std::size_t>() - 1;
  }
  std::vector<std::string> words(const char* key) {
    const Json& value = required(key);
    const auto is_text = [](const Json& entry) { return entry.is_string(); };
    if (!value.is_array() || value.size() > most_settings ||
        !std::all_of(value.begin(), value.end(), is_text))
      wrong(key, value, fmt::format("a list of at most {} texts", most_settings));
    return value.get<std::vector<std::string>>();
  }
  /// To be called last.
  void refuse_others() const {
    for (const auto& [key, value] : json_.items())
      if (!used_.contains(key)) throw InputError(fmt::format("intervention: unknown field \"{}\"", key));
  }

 private:
  const Json& required(const char* key) {
    used_.insert(key);
    const auto found = json_.find(key);
    if (found == json_.end()) throw InputError(fmt::format("intervention: field \"{}\" is missing", key));
    return *found;
  }
  static void check_number(const char* key, const Json& value, double least, double most) {
    if (!value.is_number() || !(value.get<double>() >= least && value.get<double>() <= most))
      wrong(key, value, fmt::format("{} to {}", least, most));
  }
  [[noreturn]] static void wrong(const char* key, const Json& value, const std::string& expected) {
    throw InputError(fmt::format("intervention: {} = {}: must be {}", key,
                                 value.dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 80),
                                 expected));
  }

  const Json& json_;
  std::set<std::string> used_;
};

DriveBody drive_from(Fields& fields) {
  DriveBody drive{fields.body()};
  drive.direction = {fields.number("forward", -1, 1), fields.number("left", -1, 1),
                     fields.number("up", -1, 1)};
  drive.turn = fields.number("turn", -1, 1);
  return drive;
}

Intervention from_fields(const std::string& type, Fields& fields) {
  if (type == "cover-lens") return CoverLens{fields.flag("covered")};
  if (type == "image-noise") return AddImageNoise{fields.number("sigma_gray", 0, 100)};
  if (type == "light") return ChangeLight{fields.number("factor", 0, 10)};
  if (type == "displace")
    return DisplaceBody{fields.body(), fields.vector("by_m", most_m),
                        fields.number("turn_rad", -most_rad, most_rad)};
  if (type == "push")
    return PushBody{fields.body(), fields.vector("velocity_m_s", most_m_s),
                    fields.number("duration_s", 0, most_s)};
  if (type == "take-over") return TakeOverBody{fields.body()};
  if (type == "give-back") return GiveBackBody{fields.body()};
  if (type == "drive") return drive_from(fields);
  if (type == "set") return ChangeDecision{fields.words("settings")};
  throw InputError(
      fmt::format("intervention: type = \"{}\": must be one of {}", type, fmt::join(names, ", ")));
}

Intervention from_json(const Json& json) {
  Fields fields(json);
  const std::string type = fields.word("type");
  const Intervention intervention = from_fields(type, fields);
  fields.refuse_others();
  return intervention;
}

Json parsed(std::string_view text) {
  if (json_depth(text) > most_json_depth) throw InputError("intervention: is nested too deep");
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw InputError("intervention: this is not JSON");
  return json;
}

}  // namespace

const char* name(const Intervention& intervention) {
  static_assert(std::size(names) == std::variant_size_v<Intervention>);
  return names[intervention.index()];
}

std::string intervention_json(const Intervention& intervention) {
  return json_of(intervention).dump(-1, ' ', false, Json::error_handler_t::replace);
}

Intervention intervention_from_json(std::string_view json) { return from_json(parsed(json)); }

std::string log_row(std::int64_t frame, double t, const Intervention& intervention) {
  return Json{{"frame", frame}, {"t", t}, {"intervention", json_of(intervention)}}.dump(
      -1, ' ', false, Json::error_handler_t::replace);
}

LoggedIntervention from_log_row(std::string_view row) {
  const Json json = parsed(row);
  if (!json.is_object() || !json.contains("frame") || !json["frame"].is_number_integer() ||
      !json.contains("intervention"))
    throw InputError("a row needs `frame`, a whole number, and `intervention`");
  return {json["frame"].get<std::int64_t>(), from_json(json["intervention"])};
}

}  // namespace incognita
