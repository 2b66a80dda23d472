#include "incognita/record/replay/recorded_frame.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/csv_table.hpp"
#include "incognita/record/files/json_limits.hpp"
#include "incognita/record/files/number.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

/// [u, v, weight, u, ...] becomes [[u, v, weight], ...].
void group_particles(Json& snapshot) {
  const auto matches = snapshot.find("matches");
  if (matches == snapshot.end()) return;
  for (Json& match : *matches) {
    const auto found = match.find("particles");
    if (found == match.end() || !found->is_array() || found->empty() || found->front().is_array()) continue;
    Json groups = Json::array();
    for (std::size_t i = 0; i + 2 < found->size(); i += 3)
      groups.push_back({(*found)[i], (*found)[i + 1], (*found)[i + 2]});
    *found = std::move(groups);
  }
}

void carry(const char* key, Json& from, Json& to) {
  if (to.contains(key)) return;
  if (const auto found = from.find(key); found != from.end()) to[key] = std::move(*found);
}

/// A row of map.csv as a landmark of a snapshot; unknown numbers are omitted as there.
Json landmark_of_row(const CsvTable& table, const std::vector<std::string>& row) {
  const auto number = [&](const char* column) {
    return parse_number(row.at(table.find(column).value())).value_or(std::nan(""));
  };
  Json json{{"id", std::stoll(row.at(table.find("id").value()))},
            {"kind", row.at(table.find("kind").value())},
            {"detections", static_cast<std::int64_t>(number("detections"))}};
  const double x = number("x"), y = number("y"), z = number("z");
  if (std::isfinite(x + y + z)) json["position"] = {{"x", x}, {"y", y}, {"z", z}};
  const std::vector<double> covariance{number("pxx"), number("pxy"), number("pxz"),
                                       number("pxy"), number("pyy"), number("pyz"),
                                       number("pxz"), number("pyz"), number("pzz")};
  bool known = true;
  for (const double value : covariance) known &= std::isfinite(value);
  if (known) json["covariance"] = covariance;
  return json;
}

/// Replaces the landmarks by those of the map at the end of the run, unless that is missing, incomplete or of other
/// landmarks, as after a run that was killed.
void take_final_map(const std::filesystem::path& map_csv, Json& snapshot) {
  Json landmarks = Json::array();
  std::set<std::int64_t> ids, wanted;
  try {
    const CsvTable table = read_csv(map_csv);
    for (const auto& row : table.rows) {
      landmarks.push_back(landmark_of_row(table, row));
      ids.insert(landmarks.back().at("id").get<std::int64_t>());
    }
  } catch (const InputError&) {
    return;
  } catch (const std::logic_error&) {  // a column is missing, or an id is no number
    return;
  } catch (const std::bad_optional_access&) {
    return;
  }
  for (const Json& id : snapshot.at("landmark_ids")) wanted.insert(id.get<std::int64_t>());
  if (ids == wanted) snapshot["landmarks"] = std::move(landmarks);
}

}  // namespace

std::string complete_snapshot(const RecordedFrameTexts& texts, const std::string& place) {
  try {
    Json json;
    Json& snapshot = json["snapshot"] = Json::parse(texts.snapshot);
    group_particles(snapshot);
    for (const auto* text : {&texts.with_landmarks, &texts.with_exploration}) {
      if (!*text) continue;
      Json other = Json::parse(**text);
      carry("landmarks", other, snapshot);
      carry("exploration", other, snapshot);
    }
    if (texts.map_csv) take_final_map(*texts.map_csv, snapshot);
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  } catch (const Json::exception& error) {
    throw InputError(place + ": damaged: " + brief(error));
  }
}

}  // namespace incognita
