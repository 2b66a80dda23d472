// The transforms between frames that a bag has recorded (TF), at any time: http://wiki.ros.org/tf2/Design.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "incognita/io/bags/messages.hpp"
#include "incognita/models/motion/rigid_pose.hpp"

namespace incognita {

/// Composition and inverse of poses as transforms: a_from_c = a_from_b * b_from_c.
RigidPose composed(const RigidPose& a_from_b, const RigidPose& b_from_c);
RigidPose inverse(const RigidPose& a_from_b);

/// The pose of a message; nullopt if a number is not finite or the quaternion not of unit length (to 1 %).
std::optional<RigidPose> rigid_pose(const bags::PoseMessage& message);

/// Both times of a message, ns.
struct BagStamps {
  std::int64_t header_ns = 0;    ///< 0: none
  std::int64_t recorded_ns = 0;  ///< of the recorder's clock
};

/// Takes the memory of changes: of a transform that is sent again and again the first and the last are kept.
class TransformTree {
 public:
  /// The stamps mean nothing for a static transform. Invalid transforms and those to a second parent are not used, and counted.
  void add(const bags::PoseMessage& transform, const BagStamps& stamps, bool is_static);
  /// To be called when all are added. `by_recorder`: times are those of the recorder.
  void sort(bool by_recorder);

  /// The frame, its parent, and so on to the root; the frame alone if it has no parent. Ends where a frame would repeat.
  std::vector<std::string> to_root(const std::string& frame) const;

  /// Pose of the first frame of `chain` in its last, by linear and spherical interpolation; nullopt where a transform has no
  /// neighbors in time that are the same or at most 0.25 s apart.
  std::optional<RigidPose> pose(const std::vector<std::string>& chain, std::int64_t time_ns) const;

  /// Pose of the frame `b` in the frame `a`, if it never changes.
  std::optional<RigidPose> fixed_pose(const std::string& a, const std::string& b) const;

  bool never_changes(const std::string& child) const { return edges_.at(child).is_fixed; }
  std::size_t unused() const { return unused_; }

 private:
  struct Sample {
    BagStamps stamps;
    std::int64_t time_ns;  ///< that of both stamps which counts
    RigidPose parent_from_child;
  };
  struct Edge {
    std::string parent;
    bool is_fixed = false;  ///< static, or the same in all samples
    std::vector<Sample> samples;

    bool repeats(const RigidPose& next, const BagStamps& stamps) const;
  };

  static std::optional<RigidPose> at(const Edge& edge, std::int64_t time_ns);

  std::map<std::string, Edge> edges_;  ///< by child
  std::size_t unused_ = 0;
};

}  // namespace incognita
