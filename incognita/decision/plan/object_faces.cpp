#include "incognita/decision/plan/object_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "incognita/decision/plan/expected_surface.hpp"

namespace incognita {
namespace {

constexpr double off_side_m = 0.25;      // of a landmark that is not on a side of the volume
constexpr std::size_t of_an_object = 2;  // landmarks in a cell; one alone may be wrong
constexpr double room_to_look_m = 0.7;   // in front of a face

// Objects stand on the floor: no face looks down.
const std::array<Eigen::Vector3i, 5> ways{Eigen::Vector3i(1, 0, 0), Eigen::Vector3i(-1, 0, 0),
                                          Eigen::Vector3i(0, 1, 0), Eigen::Vector3i(0, -1, 0),
                                          Eigen::Vector3i(0, 0, 1)};

}  // namespace

ObjectFaces::ObjectFaces(const ExplorationSettings& s, int first_index)
    : min_m_(s.min_m), max_m_(s.max_m), patience_s_(s.patience_s), first_index_(first_index) {
  cells_ = ((max_m_ - min_m_) / s.side_cell_m).array().round().max(1).cast<int>();
  size_m_ = (max_m_ - min_m_).cwiseQuotient(cells_.cast<double>());
}

Eigen::Vector3i ObjectFaces::cell_of(const Eigen::Vector3d& position) const {
  return (position - min_m_).cwiseQuotient(size_m_).array().floor().cast<int>();
}

int ObjectFaces::number_of(const Eigen::Vector3i& cell) const {
  return cell.x() + cells_.x() * (cell.y() + cells_.y() * cell.z());
}

void ObjectFaces::see(const std::function<bool(const Eigen::Vector3d&)>& in_view,
                      const Eigen::Vector3d& camera, double dt) {
  for (const ExpectedLandmark& e : expected_)
    if (sees_surface(camera, e.position, e.normal) && in_view(e.position)) seen_s_[e.index] += dt;
}

void ObjectFaces::add_faces(const Eigen::Vector3i& cell, const std::vector<Eigen::Vector3d>& landmarks,
                            const std::map<int, std::vector<Eigen::Vector3d>>& objects) {
  const Eigen::Vector3d center = min_m_ + (cell.cast<double>().array() + 0.5).matrix().cwiseProduct(size_m_);
  for (std::size_t way = 0; way < ways.size(); ++way) {
    const Eigen::Vector3i beside = cell + ways[way];
    if ((beside.array() < 0).any() || (beside.array() >= cells_.array()).any() ||
        objects.contains(number_of(beside)))
      continue;
    const Eigen::Vector3d normal = ways[way].cast<double>(), face = center + normal.cwiseProduct(size_m_) / 2,
                          viewpoint = face + room_to_look_m * normal;
    if ((viewpoint.array() < min_m_.array()).any() || (viewpoint.array() > max_m_.array()).any()) continue;
    const double near_m = size_m_.cwiseProduct(normal).norm() / 2;
    if (std::ranges::any_of(landmarks, [&](const auto& at) { return normal.dot(face - at) < near_m; }))
      continue;
    const int index = first_index_ + static_cast<int>(ways.size()) * number_of(cell) + static_cast<int>(way);
    const auto seen = seen_s_.find(index);
    const double probability = seen == seen_s_.end() ? 1 : still_there(seen->second, patience_s_);
    if (probability > 0) expected_.push_back({index, face, normal, probability});
  }
}

void ObjectFaces::compare(const Estimate& estimate) {
  std::map<int, std::vector<Eigen::Vector3d>> objects;
  for (const auto& [id, landmark] : estimate.landmarks) {
    const auto position = position_of(landmark, estimate);
    if (landmark.fixed || !position || position->position.size() != 3) continue;
    const Eigen::Vector3d at = position->position;
    if (!at.allFinite() || ((at - min_m_).array() < off_side_m).any() ||
        ((max_m_ - at).array() < off_side_m).any())
      continue;
    objects[number_of(cell_of(at))].push_back(at);
  }
  std::erase_if(objects, [](const auto& object) { return object.second.size() < of_an_object; });
  expected_.clear();
  for (const auto& [number, landmarks] : objects) add_faces(cell_of(landmarks.front()), landmarks, objects);
}

}  // namespace incognita
