// Relocalization of a lost camera in the whole map: landmarks are recognized by their descriptors, P3P with RANSAC
// gives poses, and active search about a pose, the joint consistency of its matches with the map and the same in further
// frames decide. Nothing is changed until then.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/slam/features/pose_verification.hpp"

namespace incognita {

class StateArchive;

class Relocalization {
 public:
  explicit Relocalization(std::uint64_t seed) : random_(seed, "slam.relocalization") {}

  /// One frame of a lost camera, at time `t`, s; its matches are those of the search around its last pose. The evidence for a
  /// pose that `confirmations` consecutive frames confirmed, the last of them this one; nothing before.
  std::optional<PoseEvidence> find(const SummedImage& image, const Estimate& estimate,
                                   const TrackedCamera& camera, double t);
  /// Forgets a pose that is not confirmed yet.
  void restart() { candidate_.reset(); }
  bool has_candidate() const { return candidate_.has_value(); }

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  struct Candidate {
    CameraState camera;
    PoseCov cov;
    double t = 0;    ///< s
    int frames = 0;  ///< that confirmed it
    void state(StateArchive& archive);
  };

  struct Tried {
    PoseEvidence evidence;
    std::vector<PointMatch> recognized;  ///< landmarks recognized in the image that the pose explains
  };
  static int distinctive_count(const Tried& tried);
  static bool is_elsewhere(const Tried& other, const Tried& best);
  std::vector<Tried> poses_in_map(const SummedImage& image, const Estimate& estimate,
                                  const TrackedCamera& camera, const std::vector<PointMatch>& recognized);
  std::optional<PoseEvidence> near_last_pose(const SummedImage& image, const Estimate& estimate,
                                             const TrackedCamera& camera);
  std::optional<PoseEvidence> confirm(const SummedImage& image, const Estimate& estimate,
                                      const TrackedCamera& camera, double t) const;
  std::optional<PoseEvidence> search(const SummedImage& image, const Estimate& estimate,
                                     const TrackedCamera& camera);

  RandomStream random_;
  std::optional<Candidate> candidate_;
  int frames_until_search_ = 0;
};

}  // namespace incognita
