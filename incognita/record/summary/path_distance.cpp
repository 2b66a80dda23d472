#include "incognita/record/summary/path_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "incognita/math/quaternion.hpp"
#include "incognita/math/unknown.hpp"
#include "incognita/record/files/quantile.hpp"
#include "incognita/record/snapshot/series.hpp"

namespace incognita {
namespace {

PathDistance of_last_third(const std::vector<double>& all) {
  const std::vector<double> late(all.begin() + static_cast<std::ptrdiff_t>(all.size() * 2 / 3), all.end());
  if (late.empty()) return {unknown, unknown};
  return {quantile(late, 0.5), quantile(late, 0.95)};
}

}  // namespace

double from_path_m(const SnapshotBody& body, bool flies, const Eigen::Vector2d& steered_m) {
  if (!body.truth || !body.reference || (!body.truth->oriented && !steered_m.isZero())) return unknown;
  const Eigen::Vector3d ahead = rotation_matrix<double>(body.truth->orientation).col(0);
  // On uneven ground the offset is horizontal, along the heading, with its full length.
  const double heading = std::atan2(ahead.y(), ahead.x());
  const Eigen::Vector2d offset = Eigen::Rotation2Dd(heading) * steered_m;
  const Eigen::Vector3d point = body.truth->position + Eigen::Vector3d(offset.x(), offset.y(), 0);
  const Eigen::Vector3d apart = point - body.reference->head<3>();
  return flies ? apart.norm() : apart.head<2>().norm();
}

void PathDistanceSummary::add(const Snapshot& s) {
  from_path_m_.resize(std::max(from_path_m_.size(), s.bodies.size()));
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    if (!has_pose(s.bodies[i])) continue;
    if (const double distance_m = from_path_m(s.bodies[i], flies_, steered_m_); std::isfinite(distance_m))
      from_path_m_[i].push_back(distance_m);
  }
}

std::vector<PathDistance> PathDistanceSummary::bodies(std::size_t count) const {
  std::vector<PathDistance> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(of_last_third(i < from_path_m_.size() ? from_path_m_[i] : std::vector<double>{}));
  return out;
}

}  // namespace incognita
