#include "incognita/record/mcap/snapshot_message.hpp"

#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "incognita/record/files/image_text.hpp"
#include "incognita/record/mcap/json_vectors.hpp"
#include "incognita/record/snapshot/interventions.hpp"
#include "incognita/record/snapshot/series.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

void put(Json& json, const char* key, double value) {
  if (std::isfinite(value)) json[key] = value;
}

/// Four decimals are sufficient for pixels and correlations; measurements.csv has full precision.
double shortened(double value) { return std::round(value * 1e4) / 1e4; }

/// Omits non-finite values: a one-dimensional measurement has no second component.
void put_shortened(Json& json, const char* key, std::initializer_list<double> values) {
  Json list = Json::array();
  for (const double value : values)
    if (std::isfinite(value)) list.push_back(shortened(value));
  if (!list.empty()) json[key] = std::move(list);
}

/// Row-major.
void put(Json& json, const char* key, const Eigen::MatrixXd& values) {
  if (!values.allFinite()) return;
  Json& list = json[key] = Json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j) list.push_back(values(i, j));
}

void put_particles(Json& json, const std::vector<SnapshotParticle>& particles, ParticleLists lists) {
  constexpr double least_weight = 1e-3;
  Json all = Json::array();
  for (const SnapshotParticle& particle : particles) {
    if (!(particle.weight >= least_weight) || !particle.pixel.allFinite()) continue;
    const Json numbers{std::round(particle.pixel.x() * 10) / 10, std::round(particle.pixel.y() * 10) / 10,
                       std::round(particle.weight * 1e3) / 1e3};
    if (lists == ParticleLists::grouped)
      all.push_back(numbers);
    else
      all.insert(all.end(), numbers.begin(), numbers.end());
  }
  if (!all.empty()) json["particles"] = std::move(all);
}

Json match_json(const SnapshotMatch& match, ParticleLists particles) {
  Json json{{"id", match.of_body ? match.id + 1 : match.id},
            {"kind", kind(match)},
            {"outcome", name(match.outcome)},
            {"body", match.body + 1},
            {"sensor", match.sensor + 1},
            {"image", match.image}};
  const Eigen::Matrix2d& S = match.innovation_cov;
  put_shortened(json, "predicted", {match.predicted.x(), match.predicted.y()});
  put_shortened(json, "innovation_cov", {S(0, 0), S(0, 1), S(1, 1)});
  put_particles(json, match.particles, particles);
  if (!match.measured) return json;
  put_shortened(json, "measured", {match.measured->x(), match.measured->y()});
  if (match.image) put(json, "correlation", shortened(match.correlation));
  return json;
}

Json decision_json(const SnapshotDecision& decision) {
  Json json{{"decided", decision.decided}, {"chosen", decision.chosen}};
  Json& candidates = json["candidates"] = Json::array();
  for (std::size_t i = 0; i < decision.actions.size(); ++i) {
    Json candidate = Json::object();
    candidate["action"] = decision.actions[i];
    if (i < decision.scores.size()) put(candidate, "score", decision.scores[i]);
    candidates.push_back(std::move(candidate));
  }
  return json;
}

void put_pose(Json& json, const SnapshotBody& body) {
  if (!has_pose(body) || !body.estimate.position.allFinite()) return;
  json["position"] = xyz(body.estimate.position);
  json["orientation"] = quaternion(body.estimate.orientation);
  put(json, "pose_covariance", Eigen::MatrixXd(body.covariance));
  if (body.velocity) {
    json["velocity"] = xyz(body.velocity->head<3>());
    json["angular_rate"] = xyz(body.velocity->tail<3>());
  }
}

void put_truth(Json& json, const StampedPose& truth) {
  if (!truth.position.allFinite()) return;
  Json& pose = json["truth"];
  pose["position"] = xyz(truth.position);
  if (truth.oriented && truth.orientation.allFinite()) pose["orientation"] = quaternion(truth.orientation);
}

Json body_json(const SnapshotBody& body) {
  Json json{{"state", name(body.state)}};
  put_pose(json, body);
  if (body.truth) put_truth(json, *body.truth);
  if (body.reference) put(json, "reference", Eigen::MatrixXd(*body.reference));
  if (body.input.size() > 0) put(json, "input", Eigen::MatrixXd(body.input));
  json["operator_controlled"] = body.operator_controlled;
  if (body.manual) json["manual"] = true;
  json["decision"] = decision_json(body.decision);
  return json;
}

Json landmark_json(const SnapshotLandmark& landmark) {
  Json json{{"id", landmark.id},
            {"kind", landmark.anchor ? "anchor" : "landmark"},
            {"detections", landmark.detection_count}};
  if (landmark.position.allFinite()) json["position"] = xyz(landmark.position);
  put(json, "covariance", Eigen::MatrixXd(landmark.covariance));
  return json;
}

Json exploration_json(const ExplorationVolume& volume) {
  const auto list = [](const auto& v) { return Json{v[0], v[1], v[2]}; };
  const std::string_view bits(reinterpret_cast<const char*>(volume.seen.data()), volume.seen.size());
  return {{"min", list(volume.min_m)},
          {"max", list(volume.max_m)},
          {"cell_m", volume.cell_m},
          {"cells", list(volume.cells)},
          {"seen", base64(bits)}};
}

Json entropy_json(const SnapshotEntropy& entropy) {
  Json json = Json::object();
  put(json, "vehicle", entropy.vehicle);
  put(json, "map", entropy.map);
  put(json, "total", entropy.total);
  put(json, "t", entropy.t);
  return json;
}

}  // namespace

std::string snapshot_message(const Snapshot& snapshot, bool landmarks, ParticleLists particles) {
  Json json{{"frame", snapshot.tick.frame},
            {"t", snapshot.tick.t},
            {"dt", snapshot.tick.dt},
            {"state", name(snapshot.status.state)},
            {"reason", snapshot.status.reason}};
  Json& bodies = json["bodies"] = Json::array();
  for (const SnapshotBody& body : snapshot.bodies) bodies.push_back(body_json(body));
  json["matched"] = snapshot.matched;
  json["predicted"] = snapshot.predicted;
  json["nis_dof"] = snapshot.nis_dof;
  if (snapshot.nis_dof > 0) put(json, "nis", snapshot.nis);
  json["entropy"] = entropy_json(snapshot.entropy);
  if (snapshot.coverage) put(json, "coverage", *snapshot.coverage);
  if (snapshot.mapped) put(json, "mapped", *snapshot.mapped);
  if (snapshot.entropy_extended) put(json, "entropy_extended", *snapshot.entropy_extended);
  if (!snapshot.interventions.empty()) {
    Json& interventions = json["interventions"] = Json::array();
    for (const Intervention& intervention : snapshot.interventions)
      interventions.push_back(Json::parse(intervention_json(intervention)));
  }
  Json& matches = json["matches"] = Json::array();
  for (const SnapshotMatch& match : snapshot.matches) matches.push_back(match_json(match, particles));
  Json& ids = json["landmark_ids"] = Json::array();
  for (const SnapshotLandmark& landmark : snapshot.landmarks) ids.push_back(landmark.id);
  if (landmarks) {
    Json& map = json["landmarks"] = Json::array();
    for (const SnapshotLandmark& landmark : snapshot.landmarks) map.push_back(landmark_json(landmark));
    if (snapshot.exploration) json["exploration"] = exploration_json(*snapshot.exploration);
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace incognita
