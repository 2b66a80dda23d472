#include "incognita/record/files/tum.hpp"

#include <gtest/gtest.h>

#include "incognita/math/random.hpp"
#include "incognita/messages/errors.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Scratch;

Trajectory read(const std::string& text) {
  const Scratch scratch;
  testing::write(scratch / "poses", text);
  return read_trajectory(scratch / "poses");
}

/// The error message.
std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ReadTrajectory, ReadsTum) {
  const Trajectory poses =
      read("# a comment\n\n1305031102.175304 1 2 3 0.1 0.2 0.3 0.9273618\r\n  2\t1 2 3 0 0 0 1\n");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].t, 1305031102.175304);
  EXPECT_EQ(poses[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(poses[0].orientation.isApprox(Eigen::Vector4d(0.9273618, 0.1, 0.2, 0.3), 1e-6));  // w first
  EXPECT_NEAR(poses[0].orientation.norm(), 1, 1e-15);
  EXPECT_EQ(poses[1].orientation, Eigen::Vector4d(1, 0, 0, 0));
}

TEST(ReadTrajectory, ReadsEuroc) {
  const Trajectory poses = read(
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
      "v_x\n"
      "1403636580838555648,4.688319,-1.786938,0.783338,0.534108,-0.153029,-0.827383,-0.082152,-0.027876\n");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_NEAR(poses[0].t, 1403636580.838555648, 1e-6);
  EXPECT_EQ(poses[0].position, Eigen::Vector3d(4.688319, -1.786938, 0.783338));
  EXPECT_NEAR(poses[0].orientation[0], 0.534108, 1e-5);
  EXPECT_NEAR(poses[0].orientation[2], -0.827383, 1e-5);
}

TEST(ReadTrajectory, TakesTheOrderOfTheQuaternionFromTheHeader) {
  const Trajectory poses = read("#timestamp,tx,ty,tz,qw,qx,qy,qz\n1403636579763555584,1,2,3,0.8,0.6,0,0\n");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_TRUE(poses[0].orientation.isApprox(Eigen::Vector4d(0.8, 0.6, 0, 0)));
}

TEST(ReadTrajectory, ReadsTumWithCommasInTheHeader) {
  for (const char* header : {"# timestamp, tx, ty, tz, qx, qy, qz, qw\n", "#timestamp,tx,ty,tz,qx,qy,qz,qw\n",
                             "timestamp,x,y,z,qx,qy,qz,qw\n", "# timestamp tx ty tz qx qy qz qw\n",
                             "timestamp tx ty tz qx qy qz qw\n"}) {
    const Trajectory poses = read(std::string(header) + "12.5,1,2,3,0.6,0,0,0.8\n");
    ASSERT_EQ(poses.size(), 1u) << header;
    EXPECT_EQ(poses[0].t, 12.5) << header;
    EXPECT_TRUE(poses[0].orientation.isApprox(Eigen::Vector4d(0.8, 0.6, 0, 0))) << header;
  }
}

TEST(ReadTrajectory, ReadsEurocStampsWithTrailingZeros) {
  const Trajectory poses = read("timestamp,x,y,z,qw,qx,qy,qz\n1403636580838555648.0,1,2,3,0.8,0.6,0,0\n");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_NEAR(poses[0].t, 1403636580.838555648, 1e-6);
  EXPECT_TRUE(poses[0].orientation.isApprox(Eigen::Vector4d(0.8, 0.6, 0, 0)));
}

TEST(ReadTrajectory, ErrorsNameTheLineAndTheReason) {
  EXPECT_NE(refusal("0 0 0 0 0 0 0 1\n1 0 0\n").find("poses:2: 3 columns"), std::string::npos);
  EXPECT_NE(refusal("0 0 0 zero 0 0 0 1\n").find("`zero` is not a number"), std::string::npos);
  EXPECT_NE(refusal("0 0 nan 0 0 0 0 1\n").find("finite"), std::string::npos);
  EXPECT_NE(refusal("0 0 1e999 0 0 0 0 1\n").find("poses:1"), std::string::npos);
  EXPECT_NE(refusal("0 0 0 0 0 0 0 2\n").find("length 2"), std::string::npos);
  EXPECT_NE(refusal("0 0 0 0 0 0 0 0\n").find("length 0"), std::string::npos);
  EXPECT_NE(refusal("").find("no pose"), std::string::npos);
  EXPECT_NE(refusal("# only a comment\n").find("no pose"), std::string::npos);
  EXPECT_NE(refusal("#timestamp,x\n12.5,0,0,0,1,0,0,0\n").find("nanoseconds"), std::string::npos);
  EXPECT_NE(refusal(std::string(200000, '7')).find("text file"), std::string::npos);
}

TEST(ReadTrajectory, RefusesAMissingFile) {
  EXPECT_THROW(read_trajectory("/nowhere.tum"), InputError);
  EXPECT_THROW(read_trajectory("/tmp"), InputError);
}

TEST(ReadTrajectory, SurvivesRandomBytes) {
  RandomStream random(11, "garbage");
  const std::string good = "0.5 1 2 3 0 0 0 1\n";
  for (int run = 0; run < 300; ++run) {
    std::string text;
    for (int i = 0; i < 5; ++i) text += good;
    for (int k = random.below(20); k >= 0; --k)
      text[static_cast<std::size_t>(random.below(static_cast<int>(text.size())))] =
          static_cast<char>(random.below(256));
    try {
      for (const StampedPose& pose : read(text)) EXPECT_NEAR(pose.orientation.norm(), 1, 1e-9);
    } catch (const InputError&) {
    }
  }
}

TEST(ReadCovariances, RefusesShortRows) {
  const Scratch scratch;
  testing::write(scratch / "c.csv", "t,x_x\n1,2,3\n");
  EXPECT_THROW(read_covariances(scratch / "c.csv"), InputError);
}

TEST(Tum, AcceptsATruthWithoutOrientation) {
  const Scratch scratch;
  const auto known = read_trajectory(scratch.write("a.tum", "# t x\n1 2 3 4 0 0 0 1\n"));
  const auto blind = read_trajectory(scratch.write(
      "b.tum", "# t x y z, world_from_vehicle; the orientation is not known\n1 2 3 4 0 0 0 1\n"));
  EXPECT_TRUE(known.front().oriented);
  EXPECT_FALSE(blind.front().oriented);
  const PoseError error = pose_error(blind.front(), known.front());
  EXPECT_TRUE(error.head<3>().isZero());
  EXPECT_TRUE(error.tail<3>().array().isNaN().all());
}

}  // namespace
}  // namespace incognita
