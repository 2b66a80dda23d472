#include "incognita/record/summary/team_summary.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "incognita/math/quaternion.hpp"
#include "incognita/record/files/quantile.hpp"

namespace incognita {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double over(double sum, std::int64_t count) { return count > 0 ? sum / static_cast<double>(count) : unknown; }

}  // namespace

double from_path_m(const SnapshotVehicle& v, bool flies, const Eigen::Vector2d& steered_m) {
  if (!v.truth || !v.reference) return unknown;
  const Eigen::Vector3d ahead = rotation_matrix<double>(v.truth->orientation).col(0);
  // On uneven ground the offset is horizontal, along the heading, with its full length.
  const double heading = std::atan2(ahead.y(), ahead.x());
  const Eigen::Vector2d offset = Eigen::Rotation2Dd(heading) * steered_m;
  const Eigen::Vector3d point = v.truth->position + Eigen::Vector3d(offset.x(), offset.y(), 0);
  const Eigen::Vector3d apart = point - v.reference->head<3>();
  return flies ? apart.norm() : apart.head<2>().norm();
}

void TeamSummary::add(const Snapshot& s) {
  vehicles_.resize(s.vehicles.size());
  for (std::size_t i = 0; i < s.vehicles.size(); ++i) {
    const SnapshotVehicle& v = s.vehicles[i];
    Sums& sums = vehicles_[i];
    if (!v.truth) continue;
    sums.squares += (v.truth->position - v.estimate.position).squaredNorm();
    ++sums.compared;
    if (const auto nees = pose_nees(pose_error(*v.truth, v.estimate), v.covariance))
      sums.nees += *nees, ++sums.nees_count;
    if (v.reference) sums.from_path_m.push_back(from_path_m(v, flies_, steered_m_));
  }
}

std::vector<TeamSummary::Vehicle> TeamSummary::vehicles() const {
  std::vector<Vehicle> out;
  for (const Sums& sums : vehicles_) {
    const auto& all = sums.from_path_m;
    const std::vector<double> late(all.begin() + static_cast<std::ptrdiff_t>(all.size() * 2 / 3), all.end());
    out.push_back({sums.compared, std::sqrt(over(sums.squares, sums.compared)),
                   over(sums.nees, sums.nees_count), late.empty() ? unknown : quantile(late, 0.5),
                   late.empty() ? unknown : quantile(late, 0.95)});
  }
  return out;
}

}  // namespace incognita
