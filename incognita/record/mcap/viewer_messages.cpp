#include "incognita/record/mcap/viewer_messages.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "incognita/math/quaternion.hpp"
#include "incognita/record/files/image_text.hpp"
#include "incognita/record/mcap/json_vectors.hpp"
#include "incognita/record/mcap/message_schemas.hpp"
#include "incognita/record/snapshot/outcome_color.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

constexpr double anchor_diameter_m = 0.03;
constexpr double min_diameter_m = 0.004;  // keeps accurately known landmarks visible
const Json nothing = Json::array();       // for lists that viewers require
constexpr int line_loop = 2;              // in foxglove.PointsAnnotation

Json stamp(std::uint64_t time_ns) {
  return {{"sec", time_ns / 1'000'000'000}, {"nsec", time_ns % 1'000'000'000}};
}

Json pose(const Eigen::Vector3d& position, const Eigen::Vector4d& orientation) {
  return {{"position", xyz(position)}, {"orientation", quaternion(orientation)}};
}

Json color(double red, double green, double blue, double opacity = 1) {
  return {{"r", red}, {"g", green}, {"b", blue}, {"a", opacity}};
}

/// The size of the message is a diameter: twice the 2-sigma half axes.
Json ellipsoid(const SnapshotLandmark& landmark) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(landmark.covariance);
  Eigen::Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) *= -1;  // keeps a rotation, not a reflection
  const Eigen::Vector3d diameter = 4 * solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  return {{"pose", pose(landmark.position, quaternion_from_matrix(axes))},
          {"size", xyz(diameter.cwiseMax(min_diameter_m))},
          {"color", color(0.2, 0.6, 0.9, 0.6)}};
}

Json ball(const SnapshotLandmark& anchor) {
  return {{"pose", pose(anchor.position, {1, 0, 0, 0})},
          {"size", xyz(Eigen::Vector3d::Constant(anchor_diameter_m))},
          {"color", color(1, 0.55, 0)}};
}

/// A resolution of 0.1 px is sufficient for display and needs a third of the digits. Origin: corner of pixel (0,0).
Json pixel(const Eigen::Vector2d& p) {
  const auto tenths = [](double x) { return std::round((std::clamp(x, -1e6, 1e6) + 0.5) * 10) / 10; };
  return {{"x", tenths(p.x())}, {"y", tenths(p.y())}};
}

Json outline(const Json& time, MatchOutcome outcome, const std::vector<Eigen::Vector2d>& corners) {
  const auto [red, green, blue] = outcome_color(outcome);
  const auto hundredths = [](int byte) { return std::round(byte / 2.55) / 100; };
  Json points = Json::array();
  for (const Eigen::Vector2d& corner : corners) points.push_back(pixel(corner));
  return {{"timestamp", time},
          {"type", line_loop},
          {"points", std::move(points)},
          {"outline_color", color(hundredths(red), hundredths(green), hundredths(blue))},
          {"outline_colors", nothing},
          {"fill_color", color(0, 0, 0, 0)},
          {"thickness", 1}};
}

/// Polygon approximation of the 3-sigma ellipse, finer for a larger one; empty if the ellipse is undefined.
std::vector<Eigen::Vector2d> search_ellipse(const SnapshotMatch& match) {
  if (match.outcome == MatchOutcome::not_searched) return {};
  if (!match.predicted.allFinite() || !match.innovation_cov.allFinite()) return {};
  const Eigen::LLT<Eigen::Matrix2d> root(match.innovation_cov);
  if (root.info() != Eigen::Success) return {};
  const Eigen::Matrix2d L = 3 * Eigen::Matrix2d(root.matrixL());
  const int corners = L.norm() < 6 ? 8 : 24;
  std::vector<Eigen::Vector2d> polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    polygon.emplace_back(match.predicted + L * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

std::vector<Eigen::Vector2d> found_patch(const SnapshotMatch& match, int patch_size_px) {
  if (match.outcome == MatchOutcome::not_searched || !match.measured || !match.measured->allFinite())
    return {};
  const double h = 0.5 * patch_size_px;
  std::vector<Eigen::Vector2d> square{{-h, -h}, {h, -h}, {h, h}, {-h, h}};
  for (Eigen::Vector2d& corner : square) corner += *match.measured;
  return square;
}

}  // namespace

std::string frame_transform(std::uint64_t time_ns, std::string_view parent, std::string_view child,
                            const StampedPose& child_in_parent) {
  return Json{{"timestamp", stamp(time_ns)},
              {"parent_frame_id", parent},
              {"child_frame_id", child},
              {"translation", xyz(child_in_parent.position)},
              {"rotation", quaternion(child_in_parent.orientation)}}
      .dump();
}

std::string pose_in_frame(std::uint64_t time_ns, std::string_view frame, const StampedPose& stamped) {
  return Json{{"timestamp", stamp(time_ns)},
              {"frame_id", frame},
              {"pose", pose(stamped.position, stamped.orientation)}}
      .dump();
}

std::string scene_update(std::uint64_t time_ns, std::string_view frame,
                         const std::vector<SnapshotLandmark>& landmarks) {
  Json ellipsoids = Json::array(), balls = Json::array();
  for (const SnapshotLandmark& landmark : landmarks) {
    if (!landmark.position.allFinite() || !landmark.covariance.allFinite()) continue;
    if (landmark.anchor)
      balls.push_back(ball(landmark));
    else
      ellipsoids.push_back(ellipsoid(landmark));
  }
  const auto entity = [&](const char* id, Json spheres) {
    Json json{{"timestamp", stamp(time_ns)}, {"frame_id", frame},     {"id", id},
              {"lifetime", stamp(0)},        {"frame_locked", false}, {"spheres", std::move(spheres)}};
    for (const char* kind : message_schemas::unused_in_scenes) json[kind] = nothing;
    return json;
  };
  Json update;
  update["deletions"] = nothing;
  update["entities"].push_back(entity("anchors", std::move(balls)));
  update["entities"].push_back(entity("landmarks", std::move(ellipsoids)));
  return update.dump();
}

std::string compressed_image(std::uint64_t time_ns, std::string_view frame, const Image& image) {
  return Json{
      {"timestamp", stamp(time_ns)}, {"frame_id", frame}, {"data", base64(jpeg(image))}, {"format", "jpeg"}}
      .dump();
}

std::string image_annotations(std::uint64_t time_ns, const std::vector<SnapshotMatch>& matches,
                              int patch_size_px) {
  const Json time = stamp(time_ns);
  Json outlines = Json::array();
  for (const SnapshotMatch& match : matches)
    for (const auto& polygon : {search_ellipse(match), found_patch(match, patch_size_px)})
      if (!polygon.empty()) outlines.push_back(outline(time, match.outcome, polygon));
  return Json{{"circles", nothing}, {"points", std::move(outlines)}, {"texts", nothing}}.dump();
}

}  // namespace incognita
