// Starts of a camera from the sheet in the rendered room: accurate when near, and refused rather than wrong
// when far.
#include <gtest/gtest.h>

#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/io/scenario/target_file.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/slam/features/target_pose.hpp"
#include "incognita/world/rendered/render.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

struct From {
  double distance_m, sigma_heading_rad;
  int first_room, rooms;
  double sigma_px = 0.06;  ///< of a corner: what `room` has, white and lasting together
  bool pictured = true;
};

struct Found {
  int pictures = 0, poses = 0;
  double most_m = 0;       ///< greatest error of a pose
  double most_sigmas = 0;  ///< the same as Mahalanobis distance
};

/// Starts about a distance from the sheet, over several rooms, facing it approximately.
Found found_from(const From& from) {
  const LoadedScenario loaded = load_scenario("room");
  const Scenario& s = loaded.scenario;
  const Camera camera = make_camera(s.camera);
  Target target = load_target(loaded);
  if (!from.pictured) target.picture.reset();
  const RayTable rays(camera);
  Found found;
  for (int seed = from.first_room; seed < from.first_room + from.rooms; ++seed) {
    const Room room(s.room, seed);
    RandomStream random(seed, "start");
    const auto about = [&](double sigma) { return sigma * random.normal(); };
    const Eigen::Vector3d at(3 - from.distance_m, about(0.2), 1.3 + about(0.2));
    Image image;
    render(room, rays, at, level_gaze(about(from.sigma_heading_rad)), image);
    SummedImage summed;
    summed.assign(image);
    const TargetSearch search = find_target(target, camera, summed, from.sigma_px);
    ++found.pictures;
    EXPECT_NE(search.pose.has_value(), !search.reason.empty()) << "a pose, or the reason for its absence";
    if (!search.pose) continue;
    ++found.poses;
    const Eigen::Vector3d off = search.pose->position - at;
    const Eigen::Matrix3d P = search.pose->covariance.topLeftCorner<3, 3>();
    found.most_m = std::max(found.most_m, off.norm());
    found.most_sigmas = std::max(found.most_sigmas, std::sqrt(off.dot(P.ldlt().solve(off))));
  }
  return found;
}

TEST(TargetStart, NearTheSheetItIsDetected) {
  for (const double sigma_px : {0.06, 0.4})
    for (const double distance_m : {0.9, 1.4}) {
      const Found found = found_from({distance_m, 0.1, 1, 8, sigma_px});
      EXPECT_GE(found.poses, 7) << "of " << found.pictures << " from " << distance_m << " m";
      EXPECT_LT(found.most_m, 0.15) << distance_m;
      EXPECT_LT(found.most_sigmas, 3.5) << distance_m;
    }
}

/// From far its corners are a few pixels apart, and other texture has a similar arrangement.
TEST(TargetStart, FromFarNoOtherTextureIsAccepted) {
  for (const double sigma_px : {0.06, 0.4}) {
    for (const double distance_m : {2.4, 3.0, 4.0}) {
      const Found found = found_from({distance_m, 0.1, 1, 8, sigma_px});
      EXPECT_LT(found.most_m, 0.6) << found.poses << " of " << found.pictures << " from " << distance_m
                                   << " m";
    }
    EXPECT_EQ(found_from({4, 0.5, 32, 1, sigma_px}).poses, 0);
  }
  EXPECT_GT(found_from({4, 0.5, 32, 1, 0.4, false}).most_m, 1) << "without the picture";
}

/// If the picture differs from the sheet, the reason names the picture, not the corners.
TEST(TargetStart, ReportsADifferentPicture) {
  const LoadedScenario loaded = load_scenario("room");
  const Camera camera = make_camera(loaded.scenario.camera);
  const Room room(loaded.scenario.room, 1);
  Image image;
  render(room, RayTable(camera), {1.6, 0, 1.3}, level_gaze(0), image);
  SummedImage summed;
  summed.assign(image);
  const auto reason = [&](const auto& change) {
    Target target = load_target(loaded);
    change(*target.picture);
    return find_target(target, camera, summed, 0.06).reason;
  };
  EXPECT_EQ(reason([](Target::Picture&) {}), "");
  EXPECT_HAS(reason([](Target::Picture& p) { p.world_from_px(1, 2) += 0.05; }),
             "and must be to 0.98: start nearer");
  EXPECT_HAS(reason([](Target::Picture& p) { p.world_from_px(1, 2) += 20; }),
             "less than half of its picture");
  EXPECT_HAS(reason([](Target::Picture& p) {
               for (int v = 0; v < p.image.height(); ++v)
                 for (int u = 0; u < p.image.width(); ++u) p.image(u, v) = 255 - p.image(u, v);
             }),
             "only, and must be to 0.7");
}

}  // namespace
}  // namespace incognita
