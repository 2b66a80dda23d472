#include "incognita/live/robot/ros_messages.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "incognita/live/robot/rosbridge.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/image_text.hpp"
#include "incognita/record/files/json_limits.hpp"

namespace incognita::ros {
namespace {

using Json = nlohmann::json;

constexpr std::int64_t ns_per_s = 1'000'000'000;
constexpr std::size_t most_distortion = 14;
constexpr int most_px = 16384;

/// One message or a part of it, with the path to it for errors: "nav_msgs/Odometry: twist.twist".
class Part {
 public:
  Part(const Json& json, std::string path) : json_(json), path_(std::move(path)) {
    if (!json_.is_object()) fail("must be an object");
  }

  [[noreturn]] void fail(const std::string& why) const { throw InputError(path_ + ": " + why); }
  bool has(const char* key) const { return json_.contains(key); }
  Part part(const char* key) const {
    if (!has(key)) fail(fmt::format("field \"{}\" is missing", key));
    return {json_[key], path_ + (path_.find(": ") == std::string::npos ? ": " : ".") + key};
  }
  double number(const char* key) const {
    const double value = has(key) && json_[key].is_number() ? json_[key].get<double>() : NAN;
    if (!std::isfinite(value)) fail(fmt::format("field \"{}\" must be a finite number", key));
    return value;
  }
  double number_or_0(const char* key) const { return has(key) ? number(key) : 0; }
  std::int64_t whole(const char* key, std::int64_t least, std::int64_t most) const {
    const double value = number(key);
    if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most)))
      fail(fmt::format("field \"{}\" = {} must be {} to {}", key, value, least, most));
    return json_[key].get<std::int64_t>();
  }
  std::string text_or(const char* key, const char* otherwise) const {
    if (!has(key)) return otherwise;
    if (!json_[key].is_string()) fail(fmt::format("field \"{}\" must be a text", key));
    return json_[key].get<std::string>();
  }
  /// A field with another name in each generation.
  const char* either(const char* one, const char* other) const {
    if (!has(one) && !has(other)) fail(fmt::format("field \"{}\" or \"{}\" is missing", one, other));
    return has(one) ? one : other;
  }
  std::vector<double> numbers(const char* key, std::size_t most) const {
    std::vector<double> values;
    if (!has(key)) return values;
    if (!json_[key].is_array() || json_[key].size() > most)
      fail(fmt::format("field \"{}\" must be a list of at most {} numbers", key, most));
    for (const Json& value : json_[key]) {
      if (!value.is_number() || !std::isfinite(value.get<double>()))
        fail(fmt::format("field \"{}\" must have finite numbers only", key));
      values.push_back(value.get<double>());
    }
    return values;
  }
  std::string bytes(const char* key) const {
    if (!has(key)) fail(fmt::format("field \"{}\" is missing", key));
    if (json_[key].is_string())
      if (auto decoded = from_base64(json_[key].get_ref<const std::string&>())) return *std::move(decoded);
    if (json_[key].is_array()) return listed_bytes(key);
    fail(fmt::format("field \"{}\" must be base64 text or a list of bytes", key));
  }

 private:
  std::string listed_bytes(const char* key) const {
    std::string bytes;
    for (const Json& value : json_[key]) {
      const int byte = value.is_number_integer() ? value.get<int>() : -1;
      if (byte < 0 || byte > 255) fail(fmt::format("field \"{}\" must have numbers from 0 to 255", key));
      bytes.push_back(static_cast<char>(byte));
    }
    return bytes;
  }

  const Json& json_;
  std::string path_;
};

/// The message as JSON; must live as long as its parts.
Json document(std::string_view json, const char* type) {
  if (json_depth(json) > most_json_depth) throw InputError(fmt::format("{}: is nested too deep", type));
  Json parsed = Json::parse(json, nullptr, false);
  if (parsed.is_discarded()) throw InputError(fmt::format("{}: is not JSON", type));
  return parsed;
}

std::int64_t stamp_of(const Part& header) {
  const Part stamp = header.part("stamp");
  constexpr std::int64_t most_s = 9'000'000'000;  // of 64 bits in nanoseconds
  return stamp.whole(stamp.either("sec", "secs"), 0, most_s) * ns_per_s +
         stamp.whole(stamp.either("nanosec", "nsecs"), 0, ns_per_s - 1);
}

Header header_of(const Part& message) {
  const Part header = message.part("header");
  return {stamp_of(header), header.text_or("frame_id", "")};
}

Eigen::Vector3d vector_of(const Part& v) {
  return {v.number_or_0("x"), v.number_or_0("y"), v.number_or_0("z")};
}

Twist twist_of(const Part& part) {
  Twist twist;
  if (part.has("linear")) twist.linear = vector_of(part.part("linear"));
  if (part.has("angular")) twist.angular = vector_of(part.part("angular"));
  return twist;
}

Json header_json(const Header& header, int ros) {
  const std::int64_t s = header.stamp_ns / ns_per_s, ns = header.stamp_ns % ns_per_s;
  Json stamp = ros == 2 ? Json{{"sec", s}, {"nanosec", ns}} : Json{{"secs", s}, {"nsecs", ns}};
  Json json{{"stamp", std::move(stamp)}, {"frame_id", header.frame_id}};
  if (ros == 1) json["seq"] = 0;
  return json;
}

Json vector_json(const Eigen::Vector3d& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }

Json twist_json(const Twist& twist) {
  return {{"linear", vector_json(twist.linear)}, {"angular", vector_json(twist.angular)}};
}

}  // namespace

CompressedImage compressed_image(std::string_view json) {
  const Json parsed = document(json, compressed_image_type);
  const Part message(parsed, compressed_image_type);
  return {header_of(message), message.text_or("format", ""), message.bytes("data")};
}

CameraInfo camera_info(std::string_view json) {
  const Json parsed = document(json, camera_info_type);
  const Part message(parsed, camera_info_type);
  CameraInfo info;
  info.header = header_of(message);
  info.width = static_cast<int>(message.whole("width", 0, most_px));
  info.height = static_cast<int>(message.whole("height", 0, most_px));
  info.distortion_model = message.text_or("distortion_model", "");
  info.distortion = message.numbers(message.either("d", "D"), most_distortion);
  const std::vector<double> K = message.numbers(message.either("k", "K"), 9);
  if (K.size() != info.K.size()) message.fail("field \"k\" (ROS 1: \"K\") must have 9 numbers");
  std::copy(K.begin(), K.end(), info.K.begin());
  return info;
}

Odometry odometry(std::string_view json) {
  const Json parsed = document(json, odometry_type);
  const Part message(parsed, odometry_type);
  Odometry out;
  out.header = header_of(message);
  const Part pose = message.part("pose").part("pose"), q = pose.part("orientation");
  out.position = vector_of(pose.part("position"));
  out.orientation = {q.number("w"), q.number("x"), q.number("y"), q.number("z")};
  out.twist = twist_of(message.part("twist").part("twist"));
  return out;
}

StampedTwist twist(std::string_view json) {
  const Json parsed = document(json, twist_type);
  const bool stamped = parsed.is_object() && parsed.contains("twist");
  const Part message(parsed, stamped ? stamped_twist_type : twist_type);
  if (!stamped) return {std::nullopt, twist_of(message)};
  const std::int64_t stamp_ns = message.has("header") ? stamp_of(message.part("header")) : 0;
  return {stamp_ns == 0 ? std::nullopt : std::optional(stamp_ns), twist_of(message.part("twist"))};
}

bool boolean(std::string_view json) {
  const Json parsed = document(json, bool_type);
  if (!parsed.is_object() || !parsed.contains("data") || !parsed["data"].is_boolean())
    throw InputError("std_msgs/Bool: field \"data\" must be true or false");
  return parsed["data"].get<bool>();
}

/// The data are written without the JSON library, which would check each of their characters.
std::string to_json(const CompressedImage& m, int ros) {
  return fmt::format(R"({{"header":{},"format":{},"data":"{}"}})", header_json(m.header, ros).dump(),
                     Json(m.format).dump(), base64(m.data));
}

std::string to_json(const CameraInfo& m, int ros) {
  const bool new_names = ros == 2;
  const std::array<double, 9> unrotated{1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::array<double, 12> P{m.K[0], m.K[1], m.K[2], 0,      m.K[3], m.K[4],
                                 m.K[5], 0,      m.K[6], m.K[7], m.K[8], 0};
  Json json{{"header", header_json(m.header, ros)},   {"width", m.width}, {"height", m.height},
            {"distortion_model", m.distortion_model}, {"binning_x", 0},   {"binning_y", 0}};
  json["roi"] = {{"x_offset", 0}, {"y_offset", 0}, {"height", 0}, {"width", 0}, {"do_rectify", false}};
  json[new_names ? "d" : "D"] = m.distortion;
  json[new_names ? "k" : "K"] = m.K;
  json[new_names ? "r" : "R"] = unrotated;
  json[new_names ? "p" : "P"] = P;
  return json.dump();
}

std::string to_json(const Odometry& m, int ros) {
  const Eigen::Vector4d& q = m.orientation;
  const std::vector<double> unknown(36, 0.0);
  const Json pose{{"position", vector_json(m.position)},
                  {"orientation", {{"w", q[0]}, {"x", q[1]}, {"y", q[2]}, {"z", q[3]}}}};
  return Json{{"header", header_json(m.header, ros)},
              {"child_frame_id", "base_link"},
              {"pose", {{"pose", pose}, {"covariance", unknown}}},
              {"twist", {{"twist", twist_json(m.twist)}, {"covariance", unknown}}}}
      .dump();
}

std::string to_json(const StampedTwist& m, int ros) {
  if (!m.stamp_ns) return twist_json(m.twist).dump();
  return Json{{"header", header_json({*m.stamp_ns, "base_link"}, ros)}, {"twist", twist_json(m.twist)}}
      .dump();
}

std::string to_json(bool value) { return Json{{"data", value}}.dump(); }

}  // namespace incognita::ros
