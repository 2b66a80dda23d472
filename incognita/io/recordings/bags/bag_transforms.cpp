#include "incognita/io/recordings/bags/bag_transforms.hpp"

#include <algorithm>
#include <cmath>

namespace incognita {
namespace {

bool same(const RigidPose& a, const RigidPose& b) {
  return a.position == b.position && a.world_from_body == b.world_from_body;
}

RigidPose between(const RigidPose& a, const RigidPose& b, double share) {
  const Eigen::Vector4d turn =
      quaternion_product<double>(quaternion_conjugate<double>(a.world_from_body), b.world_from_body);
  const Eigen::Vector3d part = share * quaternion_log<double>(turn);
  return {a.position + share * (b.position - a.position),
          quaternion_product<double>(a.world_from_body, quaternion_exp<double>(part)).normalized()};
}

}  // namespace

RigidPose composed(const RigidPose& a_from_b, const RigidPose& b_from_c) {
  return {a_from_b.position + rotation_matrix(a_from_b.world_from_body) * b_from_c.position,
          quaternion_product<double>(a_from_b.world_from_body, b_from_c.world_from_body).normalized()};
}

RigidPose inverse(const RigidPose& a_from_b) {
  const Eigen::Vector4d turned = quaternion_conjugate<double>(a_from_b.world_from_body);
  return {-(rotation_matrix(turned) * a_from_b.position), turned};
}

std::optional<RigidPose> rigid_pose(const bags::PoseMessage& message) {
  if (!message.position.allFinite() || !message.rotation.allFinite()) return std::nullopt;
  if (std::abs(message.rotation.norm() - 1) > 1e-2) return std::nullopt;
  return RigidPose{message.position, message.rotation.normalized()};
}

void TransformTree::add(const bags::PoseMessage& transform, const BagStamps& stamps, bool is_static) {
  const auto pose = rigid_pose(transform);
  const std::string& parent = transform.header.frame;
  if (!pose || transform.child.empty() || transform.child == parent) return void(++unused_);
  Edge& edge = edges_[transform.child];
  if (edge.samples.empty()) edge.parent = parent;
  if (edge.parent != parent) return void(++unused_);
  edge.is_fixed = edge.is_fixed || is_static;
  if (is_static) edge.samples.clear();  // the last one holds
  if (edge.repeats(*pose, stamps)) edge.samples.pop_back();
  edge.samples.push_back({stamps, 0, *pose});
}

/// Whether the last two samples and the next one, later by both clocks, are the same.
bool TransformTree::Edge::repeats(const RigidPose& next, const BagStamps& stamps) const {
  if (samples.size() < 2) return false;
  const Sample &last = samples.back(), &before = *std::prev(samples.end(), 2);
  return same(last.parent_from_child, next) && same(before.parent_from_child, next) &&
         before.stamps.header_ns <= last.stamps.header_ns && last.stamps.header_ns <= stamps.header_ns &&
         before.stamps.recorded_ns <= last.stamps.recorded_ns &&
         last.stamps.recorded_ns <= stamps.recorded_ns;
}

void TransformTree::sort(bool by_recorder) {
  for (auto& [child, edge] : edges_) {
    for (Sample& sample : edge.samples)
      sample.time_ns = by_recorder ? sample.stamps.recorded_ns : sample.stamps.header_ns;
    std::stable_sort(edge.samples.begin(), edge.samples.end(),
                     [](const Sample& a, const Sample& b) { return a.time_ns < b.time_ns; });
    const RigidPose& first = edge.samples.front().parent_from_child;
    edge.is_fixed =
        edge.is_fixed || std::all_of(edge.samples.begin(), edge.samples.end(),
                                     [&](const Sample& s) { return same(s.parent_from_child, first); });
  }
}

std::vector<std::string> TransformTree::to_root(const std::string& frame) const {
  std::vector<std::string> chain{frame};
  for (auto edge = edges_.find(frame); edge != edges_.end(); edge = edges_.find(chain.back())) {
    if (std::find(chain.begin(), chain.end(), edge->second.parent) != chain.end()) break;
    chain.push_back(edge->second.parent);
  }
  return chain;
}

std::optional<RigidPose> TransformTree::at(const Edge& edge, std::int64_t time_ns) {
  constexpr std::int64_t longest_gap_ns = 250'000'000;
  if (edge.is_fixed) return edge.samples.back().parent_from_child;
  const auto after = std::lower_bound(edge.samples.begin(), edge.samples.end(), time_ns,
                                      [](const Sample& s, std::int64_t t) { return s.time_ns < t; });
  if (after == edge.samples.end()) return std::nullopt;
  if (after->time_ns == time_ns) return after->parent_from_child;
  if (after == edge.samples.begin()) return std::nullopt;
  const Sample& before = *std::prev(after);
  if (same(before.parent_from_child, after->parent_from_child)) return before.parent_from_child;
  const std::int64_t gap_ns = after->time_ns - before.time_ns;
  if (gap_ns > longest_gap_ns) return std::nullopt;
  return between(before.parent_from_child, after->parent_from_child,
                 static_cast<double>(time_ns - before.time_ns) / static_cast<double>(gap_ns));
}

std::optional<RigidPose> TransformTree::pose(const std::vector<std::string>& chain,
                                             std::int64_t time_ns) const {
  RigidPose pose;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const auto parent_from_child = at(edges_.at(chain[i]), time_ns);
    if (!parent_from_child) return std::nullopt;
    pose = composed(*parent_from_child, pose);
  }
  return pose;
}

/// Up from both to the first frame that they share.
std::optional<RigidPose> TransformTree::fixed_pose(const std::string& a, const std::string& b) const {
  std::vector<std::string> from_a = to_root(a), from_b = to_root(b);
  const auto shared = std::find_first_of(from_a.begin(), from_a.end(), from_b.begin(), from_b.end());
  if (shared == from_a.end()) return std::nullopt;
  from_b.erase(std::next(std::find(from_b.begin(), from_b.end(), *shared)), from_b.end());
  from_a.erase(std::next(shared), from_a.end());
  for (const auto* chain : {&from_a, &from_b})
    for (std::size_t i = 0; i + 1 < chain->size(); ++i)
      if (!never_changes((*chain)[i])) return std::nullopt;
  return composed(inverse(*pose(from_a, 0)), *pose(from_b, 0));
}

}  // namespace incognita
