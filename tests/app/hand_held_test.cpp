// A camera that an operator carries through rendered rooms in which it once was wrong or lost.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "incognita/app/loop/assembly.hpp"

namespace incognita {
namespace {

struct Ran {
  int lost = 0;
  double rms_m = 0;
};

Ran run(const std::string& seed, const std::vector<std::string>& sets) {
  Assembly assembly =
      assemble(load_scenario("hand-held", sets, std::vector<Flag>{{"run.seed", seed, "argument"}}));
  Ran ran;
  int frames = 0;
  run_loop(
      assembly.parts,
      [&](const Snapshot& s) {
        ++frames;
        ran.lost += s.status.state == TrackingState::lost;
        ran.rms_m += (s.bodies[0].estimate.position - s.bodies[0].truth->position).squaredNorm();
      },
      [](const Tick&) { return true; });
  ran.rms_m = std::sqrt(ran.rms_m / frames);
  return ran;
}

/// The walls come as near as 0.5 m, where the prior of the depth at its default is 2 m. Ten landmarks initialized at once
/// outvoted the others: the estimate turned by 0.5 rad instead of moving, and all matches agreed.
TEST(HandHeld, NearWallsAreNotTakenForFarOnes) {
  const Ran ran = run("162", {"run.duration_s=28"});
  EXPECT_EQ(ran.lost, 0);
  EXPECT_LT(ran.rms_m, 0.03);
}

}  // namespace
}  // namespace incognita
