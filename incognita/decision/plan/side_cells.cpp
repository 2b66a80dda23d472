#include "incognita/decision/plan/side_cells.hpp"

#include <algorithm>
#include <cmath>

namespace incognita {

SideCells::SideCells(const ExplorationSettings& settings, double cell_m, double patience_s)
    : cell_m_(cell_m), patience_s_(patience_s) {
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) add_side(axis, upper, settings, cell_m);
}

void SideCells::add_side(int axis, bool upper, const ExplorationSettings& s, double cell_m) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Eigen::Vector3d size = s.max_m - s.min_m;
  const auto across = [&](int along) {
    return std::max(1, static_cast<int>(std::lround(size[along] / cell_m)));
  };
  for (int i = 0; i < across(u); ++i)
    for (int j = 0; j < across(v); ++j) {
      Cell cell;
      cell.center[axis] = upper ? s.max_m[axis] : s.min_m[axis];
      cell.center[u] = s.min_m[u] + (i + 0.5) / across(u) * size[u];
      cell.center[v] = s.min_m[v] + (j + 0.5) / across(v) * size[v];
      cell.normal.setZero();
      cell.normal[axis] = upper ? -1 : 1;
      cells_.push_back(cell);
    }
}

void SideCells::see(const std::function<bool(const Eigen::Vector3d&)>& in_view, const Eigen::Vector3d& camera,
                    double dt) {
  for (Cell& cell : cells_)
    if (cell.seen_s < patience_s_ && sees_surface(camera, cell.center, cell.normal) && in_view(cell.center))
      cell.seen_s += dt;
}

void SideCells::compare(const Estimate& estimate) {
  constexpr double off_side_m = 0.6;
  std::vector<bool> covered(cells_.size(), false);
  for (const auto& [id, landmark] : estimate.landmarks) {
    const auto position = position_of(landmark, estimate);
    if (!position || position->position.size() != 3) continue;
    const Eigen::Vector3d at = position->position;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Eigen::Vector3d off = at - cells_[i].center, normal = cells_[i].normal;
      const double away = off.dot(normal);
      covered[i] = covered[i] || (std::abs(away) < off_side_m &&
                                  (off - away * normal).lpNorm<Eigen::Infinity>() < cell_m_ / 2);
    }
  }
  expected_.clear();
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (!covered[i] && cells_[i].seen_s < patience_s_)
      expected_.push_back({static_cast<int>(i), cells_[i].center, cells_[i].normal});
}

}  // namespace incognita
