#include "incognita/record/mcap/message_schemas.hpp"

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>

namespace incognita::message_schemas {
namespace {

using Json = nlohmann::ordered_json;

struct Field {
  const char* name;
  Json schema;
  bool always = true;
};
constexpr bool sometimes = false;

Json typed(const char* type, const char* description = "") {
  Json schema;
  schema["type"] = type;
  if (*description) schema["description"] = description;
  return schema;
}

Json number(const char* description = "") { return typed("number", description); }
Json integer(const char* description = "") { return typed("integer", description); }
Json text(const char* description = "") { return typed("string", description); }
Json flag(const char* description = "") { return typed("boolean", description); }

Json array(const Json& items, const char* description = "") {
  Json schema = typed("array", description);
  schema["items"] = items;
  return schema;
}

Json one_of(std::initializer_list<const char*> words) {
  Json schema = typed("string");
  for (const char* word : words) schema["enum"].push_back(word);
  return schema;
}

Json object(std::initializer_list<Field> fields, const char* description = "") {
  Json properties = Json::object(), required = Json::array();
  for (const Field& field : fields) {
    properties[field.name] = field.schema;
    if (field.always) required.push_back(field.name);
  }
  Json schema = typed("object", description);
  schema["properties"] = std::move(properties);
  schema["required"] = std::move(required);
  schema["additionalProperties"] = false;
  return schema;
}

Json unused() { return array(object({}), "empty"); }

std::string document(const char* title, const Json& schema) {
  Json titled;
  titled["title"] = title;
  titled.update(schema);
  return titled.dump();
}

Json time(const char* description) { return object({{"sec", integer()}, {"nsec", integer()}}, description); }
Json timestamp() { return time("since the start of the run, or the time stamp of the recording"); }

Json xyz(const char* description) {
  return object({{"x", number()}, {"y", number()}, {"z", number()}}, description);
}

Json quaternion(const char* description) {
  return object({{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}}, description);
}

Json color() {
  return object({{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}}, "from 0 to 1");
}

Json pose() { return object({{"position", xyz("m")}, {"orientation", quaternion("")}}); }

Json match() {
  return object(
      {{"id", integer("of the landmark, -1 without one; of another body its index from 1")},
       {"kind", one_of({"anchor", "landmark", "ray", "body"})},
       {"outcome", one_of({"matched", "not-found", "outlier", "unconfirmed", "not-searched", "initialized"})},
       {"body", integer("index of the measuring body, from 1")},
       {"sensor", integer("index among all cameras or among the other sensors of the body, from 1")},
       {"image", flag("measured in an image; u, v in px, else in m and rad")},
       {"predicted", array(number(), "the first two components, before the measurement was used"), sometimes},
       {"innovation_cov", array(number(), "of them: 11, 12, 22"), sometimes},
       {"measured", array(number(), "the first two components"), sometimes},
       {"correlation", number("of the best match in the image"), sometimes},
       {"particles",
        array(number(),
              "of a ray: u, v (px) and probability before this match of each depth hypothesis in view, "
              "one after the other"),
        sometimes}});
}

Json decision() {
  const Json candidate = object({{"action", text()}, {"score", number("nats"), sometimes}});
  return object({{"decided", flag("whether a decision was taken in this frame")},
                 {"chosen", integer("index of the current action, -1 for none")},
                 {"candidates", array(candidate)}});
}

Json states() { return one_of({"starting", "tracking", "degraded", "lost", "relocated"}); }

Json body() {
  return object({{"state", states()},
                 {"position", xyz("m, world; not while starting or lost"), sometimes},
                 {"orientation", quaternion("world_from_body"), sometimes},
                 {"pose_covariance",
                  array(number(), "6x6, row-major: x y z (m, world), rotation (rad, body axes)"), sometimes},
                 {"truth",
                  object({{"position", xyz("m")}, {"orientation", quaternion("world_from_body"), sometimes}},
                         "in the true world"),
                  sometimes},
                 {"velocity", xyz("m/s, world; of a free camera"), sometimes},
                 {"angular_rate", xyz("rad/s, camera axes; of a free camera"), sometimes},
                 {"reference", array(number(), "x, y, z (m) and heading (rad)"), sometimes},
                 {"input", array(number(), "commanded, as its motion model takes it"), sometimes},
                 {"operator_controlled", flag("an operator moves it")},
                 {"manual", flag("a person drives it"), sometimes},
                 {"decision", decision()}});
}

Json landmark() {
  return object({{"id", integer()},
                 {"kind", one_of({"anchor", "landmark"})},
                 {"detections", integer("matches so far")},
                 {"position", xyz("m, world"), sometimes},
                 {"covariance", array(number(), "m^2, 3x3, row-major"), sometimes}});
}

Json intervention() {
  return object({{"type", one_of({"cover-lens", "image-noise", "light", "displace", "push", "take-over",
                                  "give-back", "drive", "set"})},
                 {"body", integer("index of the body, from 1"), sometimes},
                 {"covered", flag(), sometimes},
                 {"sigma_gray", number("added image noise; 0: none"), sometimes},
                 {"factor", number("of all gray values"), sometimes},
                 {"by_m", array(number(), "x y z, world"), sometimes},
                 {"turn_rad", number("about the world's z axis"), sometimes},
                 {"velocity_m_s", array(number(), "x y z, world"), sometimes},
                 {"duration_s", number(), sometimes},
                 {"forward", number("share of the largest velocity, -1 to 1"), sometimes},
                 {"left", number(), sometimes},
                 {"up", number(), sometimes},
                 {"turn", number("positive to the left"), sometimes},
                 {"settings", array(text(), "of the decision, key=value"), sometimes}});
}

Json exploration() {
  Json seen = text("one bit per cell, x fastest, the lowest bit of a byte first");
  seen["contentEncoding"] = "base64";
  return object({{"min", array(number(), "m, world: lower corner")},
                 {"max", array(number(), "m, world: upper corner")},
                 {"cell_m", number("wanted edge of a cell; cells are shrunk to fill the volume")},
                 {"cells", array(integer(), "along x, y, z")},
                 {"seen", seen}},
                "exploration volume, about once a second");
}

Json camera() {
  return object({{"width", integer("px")},
                 {"height", integer("px")},
                 {"fx", number("px")},
                 {"fy", number("px")},
                 {"cx", number("px")},
                 {"cy", number("px; the center of the first pixel is (0,0)")}},
                "intrinsics, without distortion");
}

Json room() {
  const Json min = array(number(), "m, world: x, y, z"), max = min;
  return object({{"min", min}, {"max", max}, {"boxes", array(object({{"min", min}, {"max", max}}))}},
                "interior of the rendered room, and the boxes in it");
}

Json terrain() {
  return object({{"origin", array(number(), "m, world: x, y of the first point")},
                 {"step_m", number("between neighbors")},
                 {"columns", integer("points along x")},
                 {"rows", integer("points along y")},
                 {"heights", array(number(), "m, row by row")}},
                "uneven ground");
}

Json entropy() {
  return object({{"vehicle", number(), sometimes},
                 {"map", number(), sometimes},
                 {"total", number(), sometimes},
                 {"t", number("s, the time that map and total stand for"), sometimes}},
                "nats");
}

}  // namespace

std::string frame_transform() {
  return document("foxglove.FrameTransform",
                  object({{"timestamp", timestamp()},
                          {"parent_frame_id", text()},
                          {"child_frame_id", text()},
                          {"translation", xyz("m, position of the child in the parent frame")},
                          {"rotation", quaternion("parent_from_child")}}));
}

std::string pose_in_frame() {
  return document("foxglove.PoseInFrame",
                  object({{"timestamp", timestamp()}, {"frame_id", text()}, {"pose", pose()}}));
}

std::string scene_update() {
  const Json sphere = object({{"pose", pose()}, {"size", xyz("m, diameters")}, {"color", color()}});
  Json entity = object({{"timestamp", timestamp()},
                        {"frame_id", text()},
                        {"id", text("replaces the entity with the same id")},
                        {"lifetime", time("0: until it is replaced")},
                        {"frame_locked", flag()},
                        {"spheres", array(sphere)}});
  for (const char* kind : unused_in_scenes) {
    entity["properties"][kind] = unused();
    entity["required"].push_back(kind);
  }
  return document("foxglove.SceneUpdate", object({{"deletions", unused()}, {"entities", array(entity)}}));
}

std::string compressed_image() {
  Json data = text();
  data["contentEncoding"] = "base64";
  return document(
      "foxglove.CompressedImage",
      object({{"timestamp", timestamp()}, {"frame_id", text()}, {"data", data}, {"format", text()}}));
}

std::string image_annotations() {
  const Json point = object({{"x", number("px")}, {"y", number("px")}});
  const Json outline = object({{"timestamp", timestamp()},
                               {"type", integer("2: closed polyline")},
                               {"points", array(point)},
                               {"outline_color", color()},
                               {"outline_colors", unused()},
                               {"fill_color", color()},
                               {"thickness", number("px")}});
  return document("foxglove.ImageAnnotations",
                  object({{"circles", unused()}, {"points", array(outline)}, {"texts", unused()}}));
}

std::string run() {
  return document("incognita.Run",
                  object({{"name", text("of the scenario")},
                          {"version", text("of the program")},
                          {"seed", integer()},
                          {"body", text("whose pose is estimated: camera or vehicle")},
                          {"bodies", integer("number of bodies")},
                          {"inputs", array(text(), "names of the inputs of each body, with units")},
                          {"patch_size_px", integer("side of the matched patches")},
                          {"same_frame_as_truth", flag("estimate and truth are compared without alignment")},
                          {"scale_known", flag("lengths of the estimate are in m")},
                          {"rate_hz", number("frames per second; of a recording the mean"), sometimes},
                          {"camera", camera(), sometimes},
                          {"room", room(), sometimes},
                          {"terrain", terrain(), sometimes}}));
}

std::string snapshot() {
  return document(
      "incognita.Snapshot",
      object(
          {{"frame", integer("counts from 0")},
           {"t", number("s")},
           {"dt", number("s, since the previous frame")},
           {"state", states()},
           {"reason", text("reason for the state")},
           {"bodies", array(body())},
           {"matched", integer("measurements that updated the filter")},
           {"predicted", integer("measurements predicted")},
           {"nis_dof", integer("degrees of freedom; 0 without an update")},
           {"nis", number("normalized innovation squared, sum over the measurements"), sometimes},
           {"entropy", entropy()},
           {"coverage", number("viewed share of the exploration volume"), sometimes},
           {"mapped", number("share of the simulated world that is mapped to 5 cm"), sometimes},
           {"entropy_extended", number("nats, with expected landmarks"), sometimes},
           {"interventions", array(intervention(), "of a person, before the motion of this tick"), sometimes},
           {"matches", array(match())},
           {"landmark_ids", array(integer())},
           {"landmarks", array(landmark(), "about once a second"), sometimes},
           {"exploration", exploration(), sometimes}}));
}

}  // namespace incognita::message_schemas
