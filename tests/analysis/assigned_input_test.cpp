// Motions that assign an input: to another input, a state or a draw.
#include <gtest/gtest.h>

#include <string>

#include "incognita/analysis/observability/observability.hpp"
#include "incognita/analysis/systems/system_error.hpp"
#include "incognita/io/formats/system_file.hpp"
#include "tests/analysis/remarks.hpp"

namespace incognita {
namespace {

using testing::remarks;
using testing::says;

/// A robot with two wheels of unknown radius r and distance b, and a position sensor on the axle.
SystemText wheels(const std::string& motion) {
  return read_system(
      "name = \"wheels\"\n[states]\nx = \"r/2*(wl + wr)*cos(h)\"\ny = \"r/2*(wl + wr)*sin(h)\"\n"
      "h = \"r*(wr - wl)/b\"\nr = 0\nb = 0\n[region]\nx = [-1, 1]\ny = [-1, 1]\nh = [-3, 3]\n"
      "r = [0.05, 0.1]\nb = [0.3, 0.5]\n[inputs]\nwl = [1, 5]\nwr = [1, 5]\n[measurements]\n"
      "mx = \"x\"\nmy = \"y\"\n[motion.chosen]\n" +
          motion,
      "wheels.toml");
}

ObservabilityAnalysis in_motion(const SystemText& text) {
  return analyze_observability(text, {.landmarks = 0, .motion = "chosen"});
}

void expect_ranks(const ObservabilityAnalysis& a, int lie, int local) {
  EXPECT_EQ(a.lie->space.rank, lie) << remarks(a);
  EXPECT_EQ(a.local.space.rank, local) << remarks(a);
  EXPECT_EQ(a.fisher.space.rank, local) << remarks(a);
}

TEST(AssignedInput, EqualToAnotherVariesWithIt) {
  const auto a = in_motion(read_system(
      "name = \"equal\"\n[states]\nx = \"k*(u1 - u2)\"\nk = 0\n[region]\nx = [1, 2]\nk = [1, 2]\n"
      "[inputs]\nu1 = [1, 2]\nu2 = [1, 2]\n[measurements]\nz = \"x\"\n[motion.chosen]\nu1 = \"u2\"\n",
      "equal.toml"));
  expect_ranks(a, 1, 1);
  EXPECT_FALSE(says(a, "other inputs of this kind")) << remarks(a);
}

/// A motion has the same ranks whether it is written with an input or with a draw.
TEST(AssignedInput, MayBeWrittenWithADraw) {
  const std::string draw = "draw.q = [1, 5]\n";
  const auto straight = in_motion(wheels("wl = \"wr\"\n"));
  EXPECT_EQ(straight.lie->space.rank, in_motion(wheels(draw + "wl = \"q\"\nwr = \"q\"\n")).lie->space.rank);
  expect_ranks(straight, 4, 4);
  const auto spot = in_motion(wheels("wl = \"-wr\"\n"));
  EXPECT_EQ(spot.lie->space.rank, in_motion(wheels(draw + "wl = \"-q\"\nwr = \"q\"\n")).lie->space.rank);
  expect_ranks(spot, 2, 2);
  expect_ranks(in_motion(wheels("")), 5, 5);
}

/// The order in the file does not matter: u2 is assigned before u1, which is twice u2.
TEST(AssignedInput, MayBePartOfAChain) {
  const std::string head =
      "name = \"chain\"\n[states]\nx = \"k*(u1 - 2*u2) + c*(u2 + u3)\"\nk = 0\nc = 0\n[region]\n"
      "x = [1, 2]\nk = [1, 2]\nc = [1, 2]\n[inputs]\nu1 = [1, 2]\nu2 = [1, 2]\nu3 = [1, 2]\n"
      "[definitions]\ndouble = \"2*u2\"\n[measurements]\nz = \"x\"\n[motion.chosen]\n";
  for (const char* motion : {"u1 = \"2*u2\"\nu2 = \"-u3 + 1\"\n", "u2 = \"-u3 + 1\"\nu1 = \"2*u2\"\n",
                             "u1 = \"double\"\nu2 = \"-u3 + 1\"\n"}) {
    const auto a = in_motion(read_system(head + motion, "chain.toml"));
    expect_ranks(a, 2, 2);
    for (const SystemPoint& point : a.points) {
      EXPECT_DOUBLE_EQ(point.u[1], 1 - point.u[2]) << motion;
      EXPECT_DOUBLE_EQ(point.u[0], 2 * point.u[1]) << motion;
    }
  }
}

/// k moves x only with u1 - u2*p, which is 0 in one motion and not in the other.
TEST(AssignedInput, MayDependOnStatesAndDraws) {
  const std::string head =
      "name = \"mixed\"\n[states]\nx = \"k*(u1 - u2*p)\"\np = 0\nk = 0\n[region]\nx = [1, 2]\np = [1, 2]\n"
      "k = [1, 2]\n[inputs]\nu1 = [1, 2]\nu2 = [1, 2]\n[measurements]\nz = \"x\"\nzp = \"p\"\n"
      "[motion.chosen]\n";
  expect_ranks(in_motion(read_system(head + "u1 = \"u2*p\"\n", "m.toml")), 2, 2);
  expect_ranks(in_motion(read_system(head + "u1 = \"q*u2*p\"\ndraw.q = [2, 3]\n", "m.toml")), 3, 3);
}

/// A rate that is not affine in a draw takes as many values as there are monomials of the draw.
TEST(AssignedInput, MayHaveADrawToAnyPower) {
  const std::string head =
      "name = \"powers\"\n[states]\nx = \"a + b*u + c*w\"\na = 0\nb = 0\nc = 0\n[region]\nx = [1, 2]\n"
      "a = [1, 2]\nb = [1, 2]\nc = [1, 2]\n[inputs]\nu = [1, 2]\nw = [1, 2]\n[measurements]\nz = \"x\"\n"
      "[motion.chosen]\ndraw.q = [1, 2]\nu = \"q\"\n";
  expect_ranks(in_motion(read_system(head + "w = \"q^2\"\n", "p.toml")), 4, 4);
  expect_ranks(in_motion(read_system(head + "w = \"3*q\"\n", "p.toml")), 3, 3);
  expect_ranks(in_motion(read_system(head + "w = \"abs(q - 1.5)\"\n", "p.toml")), 4, 4);
}

TEST(AssignedInput, IsAssignedBeforeStatesThatDependOnIt) {
  const auto a = in_motion(read_system(
      "name = \"start\"\n[states]\nx = \"u\"\n[region]\nx = [1, 2]\n[inputs]\nu = [1, 2]\nw = [5, 6]\n"
      "[measurements]\nz = \"x\"\n[motion.chosen]\nx = \"u\"\nu = \"w\"\n",
      "start.toml"));
  EXPECT_GE(a.points[0].u[0], 5);
  EXPECT_EQ(a.points[0].x[0], a.points[0].u[0]);
}

TEST(AssignedInput, CyclicDependenceIsRefused) {
  const auto refusal = [](const std::string& motion) -> std::string {
    try {
      in_motion(wheels(motion));
    } catch (const SystemError& error) {
      EXPECT_GT(error.location.line, 0);
      return error.what();
    }
    return "accepted";
  };
  const std::string remedy = "; replace one of them by a drawn number (draw.q = [lowest, highest])";
  EXPECT_EQ(refusal("wl = \"2*wr\"\nwr = \"wl\"\n"),
            "the motion's assignments are circular: `wl` depends on `wr`, which depends on `wl`" + remedy);
  EXPECT_EQ(refusal("wl = \"wl + 1\"\n"),
            "the motion's assignments are circular: `wl` depends on `wl`" + remedy);
  EXPECT_EQ(refusal("x = \"wl\"\nwl = \"x\"\n"),
            "the motion's assignments are circular: `x` depends on `wl`, which depends on `x`" + remedy);
}

}  // namespace
}  // namespace incognita
