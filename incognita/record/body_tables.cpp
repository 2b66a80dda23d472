#include "incognita/record/body_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "incognita/math/angles.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/math/unknown.hpp"
#include "incognita/record/files/number.hpp"
#include "incognita/record/snapshot/pose_rows.hpp"
#include "incognita/record/snapshot/series.hpp"
#include "incognita/record/summary/path_distance.hpp"

namespace incognita {
namespace {

std::string vehicles_header(const RunInfo& info) {
  std::string header = "t,vehicle,state";
  for (const char* what : {"", "two_sigma_", "true_", "reference_"})
    for (const char* number : {"x_m", "y_m", "z_m", "heading_rad"})
      header += fmt::format(",{}{}", what, number);
  header += ",from_path_m,nees_per_dof";
  for (const std::string& input : info.inputs) append_cell(header, "input_" + input);
  return header;
}

/// Heading of a vehicle's x axis or of a camera's optical axis, rad.
double heading(const StampedPose& pose, bool camera) {
  if (!pose.oriented) return unknown;
  const Eigen::Vector3d ahead = rotation_matrix<double>(pose.orientation).col(camera ? 2 : 0);
  return std::atan2(ahead.y(), ahead.x());
}

/// x, y, z (m), heading (rad).
Eigen::Vector4d four(const StampedPose& pose, bool camera) {
  return {pose.position.x(), pose.position.y(), pose.position.z(), heading(pose, camera)};
}

Eigen::Vector4d two_sigmas(const SnapshotBody& v) {
  const Eigen::Vector3d up = rotation_matrix<double>(v.estimate.orientation).row(2);  // in body axes
  Eigen::Vector4d variances;
  variances << v.covariance.diagonal().head<3>(), up.dot(v.covariance.bottomRightCorner<3, 3>() * up);
  return 2 * variances.cwiseMax(0).cwiseSqrt();
}

/// The reference with its heading wrapped like the others; that of a path grows beyond pi.
Eigen::Vector4d reference_of(const SnapshotBody& v) {
  if (!v.reference) return Eigen::Vector4d::Constant(unknown);
  Eigen::Vector4d reference = *v.reference;
  reference[3] = wrap_angle(reference[3]);
  return reference;
}

}  // namespace

std::string name_for_vehicle(const std::string& file, std::size_t vehicle) {
  const std::filesystem::path path(file);
  if (vehicle == 0) return file;
  return fmt::format("{}-{}{}", path.stem().string(), vehicle + 1, path.extension().string());
}

BodyTables::BodyTables(const RunDirectory& directory, const RunInfo& info)
    : directory_(directory),
      body_(info.body),
      compare_with_truth_(same_frame_as_truth(info)),
      steered_m_(info.steered_m),
      inputs_(info.inputs.size()) {
  vehicles_ = RowFile(directory.file("vehicles.csv"), vehicles_header(info));
  for (std::size_t i = 1; i < static_cast<std::size_t>(info.bodies); ++i) {
    Poses& poses = others_.emplace_back();
    poses.estimate = RowFile(directory.file(name_for_vehicle("estimate.tum", i)), tum_header(info.body));
    poses.covariance = RowFile(directory.file(name_for_vehicle("covariance.csv", i)), covariance_header());
  }
}

std::string BodyTables::vehicle_row(const Snapshot& s, std::size_t i) const {
  const SnapshotBody& v = s.bodies[i];
  const Eigen::Vector4d nowhere = Eigen::Vector4d::Constant(unknown);
  const bool posed = has_pose(v), camera = body_ == "camera";
  std::string row;
  append_number(row, s.tick.t);
  append_cell(row, std::to_string(i + 1));
  append_cell(row, name(v.state));
  for (const Eigen::Vector4d& numbers :
       {posed ? four(v.estimate, camera) : nowhere, posed ? two_sigmas(v) : nowhere,
        v.truth ? four(*v.truth, camera) : nowhere, reference_of(v)})
    for (const double number : numbers) append_cell(row, number);
  append_cell(row, compare_with_truth_ ? from_path_m(v, camera, steered_m_) : unknown);
  append_cell(row, compare_with_truth_ && v.truth && posed
                       ? pose_nees(pose_error(*v.truth, v.estimate), v.covariance).value_or(unknown)
                       : unknown);
  for (std::size_t k = 0; k < inputs_; ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    append_cell(row, at < v.input.size() ? v.input[at] : unknown);
  }
  return row;
}

void BodyTables::write_poses(std::size_t i, const Snapshot& s) {
  Poses& poses = others_[i - 1];
  const SnapshotBody& v = s.bodies[i];
  if (v.truth) {
    if (!poses.truth_opened)
      poses.truth =
          RowFile(directory_.file(name_for_vehicle("truth.tum", i)), tum_header(body_, v.truth->oriented));
    poses.truth_opened = true;
    poses.truth.append(tum_row(*v.truth), s.tick.t);
  }
  if (!has_pose(v)) return;
  poses.estimate.append(tum_row(v.estimate), s.tick.t);
  poses.covariance.append(covariance_row(s.tick.t, v.covariance), s.tick.t);
}

void BodyTables::write_decision(std::size_t i, const Snapshot& s) {
  const SnapshotDecision& decision = s.bodies[i].decision;
  if (!decision.decided) return;
  if (i >= actions_.size()) actions_.resize(i + 1);
  Actions& actions = actions_[i];
  if (!actions.opened) open(actions, i, decision.actions);
  std::string row;
  append_number(row, s.tick.t);
  append_cell(row, chosen_action(decision));
  for (std::size_t k = 0; k < actions.candidates; ++k)
    append_cell(row, k < decision.scores.size() ? decision.scores[k] : unknown);
  actions.file.append(row, s.tick.t);
}

void BodyTables::open(Actions& actions, std::size_t i, const std::vector<std::string>& names) {
  std::string header = "t,chosen";
  for (const std::string& name : names) append_cell(header, name);
  actions.file = RowFile(directory_.file(name_for_vehicle("actions.csv", i)), header);
  actions.candidates = names.size();
  actions.opened = true;
}

void BodyTables::publish(const Snapshot& s) {
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    vehicles_.append(vehicle_row(s, i), s.tick.t);
    if (i > 0 && i <= others_.size()) write_poses(i, s);
    write_decision(i, s);
  }
}

void BodyTables::close() {
  vehicles_.close();
  for (Poses& poses : others_)
    for (RowFile* file : {&poses.estimate, &poses.truth, &poses.covariance}) file->close();
  if (actions_.empty()) actions_.emplace_back();
  if (!actions_.front().opened) open(actions_.front(), 0, {});
  for (Actions& actions : actions_) actions.file.close();
}

}  // namespace incognita
