#include "incognita/record/mcap/run_message.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

Json list(const Eigen::VectorXd& values) { return std::vector<double>(values.begin(), values.end()); }

Json box_json(const BoxOutline& box) { return {{"min", list(box.min)}, {"max", list(box.max)}}; }

Json camera_json(const CameraIntrinsics& camera) {
  return {{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx},
          {"fy", camera.fy},       {"cx", camera.cx},         {"cy", camera.cy}};
}

Json room_json(const RoomOutline& room) {
  Json json = box_json(room.inside);
  Json& boxes = json["boxes"] = Json::array();
  for (const BoxOutline& box : room.boxes) boxes.push_back(box_json(box));
  return json;
}

/// Heights to the millimeter.
Json terrain_json(const TerrainGrid& terrain) {
  Json json{{"origin", list(terrain.origin_m)},
            {"step_m", terrain.step_m},
            {"columns", terrain.columns},
            {"rows", terrain.rows}};
  Json& heights = json["heights"] = Json::array();
  for (const double height : terrain.heights_m) heights.push_back(std::round(height * 1e3) / 1e3);
  return json;
}

}  // namespace

std::string run_message(const RunInfo& info) {
  Json json{{"name", info.name},
            {"version", info.version},
            {"seed", info.seed},
            {"body", info.body},
            {"bodies", info.bodies},
            {"inputs", info.inputs},
            {"patch_size_px", info.patch_size_px},
            {"same_frame_as_truth", same_frame_as_truth(info)},
            {"scale_known", scale_is_known(info)}};
  if (info.rate_hz) json["rate_hz"] = *info.rate_hz;
  if (info.camera) json["camera"] = camera_json(*info.camera);
  if (info.room) json["room"] = room_json(*info.room);
  if (info.terrain) json["terrain"] = terrain_json(*info.terrain);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace incognita
