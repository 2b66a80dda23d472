#include "incognita/decision/plan/side_cells.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "incognita/decision/plan/expected_surface.hpp"

namespace incognita {
namespace {

constexpr double on_side_m = 0.15;  // of a landmark on a side of the volume
constexpr double hidden_m = 0.6;    // from a landmark on an object to what it hides

void add_side(int axis, bool upper, const ExplorationSettings& s, double cell_m,
              std::vector<SideCell>& cells) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Eigen::Vector3d size = s.max_m - s.min_m;
  const auto across = [&](int along) {
    return std::max(1, static_cast<int>(std::lround(size[along] / cell_m)));
  };
  for (int i = 0; i < across(u); ++i)
    for (int j = 0; j < across(v); ++j) {
      SideCell cell;
      cell.center[axis] = upper ? s.max_m[axis] : s.min_m[axis];
      cell.center[u] = s.min_m[u] + (i + 0.5) / across(u) * size[u];
      cell.center[v] = s.min_m[v] + (j + 0.5) / across(v) * size[v];
      cell.normal[axis] = upper ? -1 : 1;
      cell.half_m[u] = size[u] / across(u) / 2;
      cell.half_m[v] = size[v] / across(v) / 2;
      cells.push_back(cell);
    }
}

void check_number(const ExplorationSettings& s) {
  constexpr double most_cells = 1e5;
  const Eigen::Array3d across = ((s.max_m - s.min_m) / s.side_cell_m).array().max(1);
  if (across.prod() > most_cells)
    throw std::invalid_argument(
        "exploration.side_cell_m: the exploration volume has more than 100000 cells of this size; take a larger one");
}

std::vector<SideCell> cells_of(const ExplorationSettings& settings) {
  check_number(settings);
  std::vector<SideCell> cells;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) add_side(axis, upper, settings, settings.side_cell_m, cells);
  return cells;
}

}  // namespace

SideCells::SideCells(const ExplorationSettings& settings)
    : min_m_(settings.min_m),
      max_m_(settings.max_m),
      patience_s_(settings.patience_s),
      cells_(cells_of(settings)),
      covered_(cells_.size(), false),
      objects_(settings, static_cast<int>(cells_.size())) {}

void SideCells::see(const std::function<bool(const Eigen::Vector3d&)>& in_view, const Eigen::Vector3d& camera,
                    double dt) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    SideCell& cell = cells_[i];
    if (!covered_[i] && sees_surface(camera, cell.center, cell.normal) && in_view(cell.center))
      cell.seen_s += dt;
  }
  objects_.see(in_view, camera, dt);
}

/// By landmarks however well they are known: what is still uncertain about them is information about the map.
void SideCells::cover(const Estimate& estimate) {
  covered_.assign(cells_.size(), false);
  for (const auto& [id, landmark] : estimate.landmarks) {
    const auto position = position_of(landmark, estimate);
    if (landmark.fixed || !position || position->position.size() != 3) continue;
    const Eigen::Vector3d at = position->position;
    const double nearest_m =
        std::min((at - min_m_).cwiseAbs().minCoeff(), (max_m_ - at).cwiseAbs().minCoeff());
    // Near an edge a landmark is on the nearest side alone. An object hides what is near behind it
    const double within_m = nearest_m < on_side_m ? nearest_m : hidden_m;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Eigen::Vector3d off = at - cells_[i].center, normal = cells_[i].normal;
      const double away = off.dot(normal);
      const Eigen::Array3d along = (off - away * normal).array().abs();
      covered_[i] = covered_[i] || (std::abs(away) <= within_m && (along <= cells_[i].half_m.array()).all());
    }
  }
}

void SideCells::compare(const Estimate& estimate) {
  cover(estimate);
  expected_.clear();
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const double probability = covered_[i] ? 0 : still_there(cells_[i].seen_s, patience_s_);
    if (probability > 0)
      expected_.push_back({static_cast<int>(i), cells_[i].center, cells_[i].normal, probability});
  }
  objects_.compare(estimate);
  expected_.insert(expected_.end(), objects_.expected().begin(), objects_.expected().end());
}

}  // namespace incognita
