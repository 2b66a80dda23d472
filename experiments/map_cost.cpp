#include "experiments/map_cost.hpp"

#include <algorithm>
#include <ctime>
#include <limits>
#include <vector>

#include "incognita/models/planar_vehicle.hpp"
#include "incognita/models/range_bearing.hpp"

namespace incognita {
namespace {

constexpr int looks_per_step = 10, steps = 60;

/// Of this thread: what else the machine does at the time does not count.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Belief mapped(int landmarks, MapCorrelations correlations, std::vector<BlockId>& ids) {
  Belief belief(3 + 2 * landmarks, correlations);
  const planar::Pose<double> pose(0, 0, 0);
  const BlockId vehicle = belief.add_vehicle(planar::pose_chart, pose, 1e-4 * Eigen::Matrix3d::Identity());
  for (int i = 0; i < landmarks; ++i) {
    const auto born = RangeBearing::birth(pose, {5 + 0.01 * i, 6.28 * i / landmarks - 3.14});
    const Belief::Parent parent{vehicle, born.Jv};
    ids.push_back(belief.augment(RangeBearing::landmark_chart, born.landmark, {&parent, 1},
                                 1e-2 * Eigen::Matrix2d::Identity()));
  }
  return belief;
}

void one_step(Belief& belief, const std::vector<BlockId>& ids, int step, std::vector<AffineLook>& looks) {
  const DifferentialDrive drive;
  const auto moved = drive.step(belief.mean(0), {0, 0.01}, 1);
  belief.predict({0, moved.x, moved.F, 1e-6 * Eigen::Matrix3d::Identity()});
  looks.clear();
  for (int i = 0; i < looks_per_step; ++i) {
    const BlockId id = ids[static_cast<std::size_t>(step * looks_per_step + i) % ids.size()];
    const auto seen = RangeBearing::look(belief.mean(0), belief.mean(id));
    AffineLook& look = looks.emplace_back();
    look.add(0, seen->Hv);
    look.add(id, seen->Hl);
    look.residual = Eigen::Vector2d::Zero();
    look.R = 1e-2 * Eigen::Matrix2d::Identity();
  }
  belief.update(looks);
}

}  // namespace

double step_seconds(int landmarks, MapCorrelations correlations) {
  std::vector<BlockId> ids;
  Belief belief = mapped(landmarks, correlations, ids);
  std::vector<AffineLook> looks;
  double fastest = std::numeric_limits<double>::infinity();
  for (int step = 0; step < steps; ++step) {
    const double start = processor_seconds();
    one_step(belief, ids, step, looks);
    fastest = std::min(fastest, processor_seconds() - start);
  }
  return fastest;
}

}  // namespace incognita
