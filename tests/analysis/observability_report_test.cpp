// What is said of drives and camera paths whose symmetries are known.
#include "incognita/analysis/observability_report.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "incognita/analysis/observability_monitor.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/planar_frame.hpp"
#include "incognita/models/range_bearing.hpp"
#include "incognita/models/wide_angle_camera.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr BlockId vehicle = 0;

const QuantityReport& quantity(const ObservabilityReport& report, const std::string& name) {
  for (const QuantityReport& q : report.quantities)
    if (q.name == name) return q;
  throw std::invalid_argument(name);
}

// A vehicle on a plane
// ---------------------------------------------------------------------------------------------------------

/// A circle among landmarks, all seen at every step; the Jacobians at the true places, or beside them by
/// `off` as those of a filter are, other each time.
struct Drive {
  explicit Drive(double off, int known = 0) {
    RandomStream random(1, "drive");
    const std::vector<Vector2d> points{{5, 3}, {8, -2}, {2, 6}, {12, 4}};
    for (int step = 0; step <= steps; ++step) {
      const planar::Pose<double> here = scene.vehicle + off * beside(random);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto seen = RangeBearing::look(here, points[i] + off * beside(random).head<2>());
        AffineLook look;
        look.add(vehicle, seen->Hv);
        if (i >= static_cast<std::size_t>(known)) look.add(static_cast<BlockId>(i) + 1, seen->Hl);
        look.residual = Vector2d::Zero();
        look.R = Vector2d(0.01, 1e-4).asDiagonal();
        monitor.look(look);
      }
      const planar::Pose<double> next =
          DifferentialDrive{}.f<double>(here, {0.5 + 0.1 * random.normal(), 0.1 + 0.1 * random.normal()}, 1);
      AffineMotion motion;
      motion.block = vehicle;
      motion.A = planar::jacobian_between(here, next);
      motion.N = Vector3d(1e-3, 1e-3, 1e-4).asDiagonal();
      monitor.move(motion);
      scene.vehicle = next;
    }
    for (std::size_t i = static_cast<std::size_t>(known); i < points.size(); ++i)
      scene.landmarks.push_back(
          {static_cast<std::int64_t>(i), monitor.find(static_cast<BlockId>(i) + 1)->first, points[i]});
    scene.errors = monitor.errors();
    fixed.anchors = known;
    fixed.places.resize(2, known);
    for (int i = 0; i < known; ++i) fixed.places.col(i) = points[static_cast<std::size_t>(i)];
  }
  static planar::Pose<double> beside(RandomStream& random) {
    return {random.normal(), random.normal(), random.normal()};
  }
  ObservabilityReport report() { return observability_report(monitor.information(), scene, fixed); }

  static constexpr int steps = 40;
  ObservabilityMonitor monitor{vehicle, 3};
  PlanarScene scene;
  FixedPoints fixed;
};

TEST(ObservabilityReport, ExactJacobiansLearnNothingOfAFrameWithoutAnchors) {
  const ObservabilityReport report = Drive(0).report();
  EXPECT_EQ(report.ideal_nullity, 3);
  EXPECT_EQ(report.information.nullity(), 3);
  EXPECT_EQ(report.information.errors, 11);
  EXPECT_FALSE(report.information.ambiguous);
  EXPECT_GT(report.information.gap(), 1e6);
  EXPECT_EQ(report.wrongly_believed, 0);
  for (const QuantityReport& q : report.quantities) {
    EXPECT_FALSE(q.ideally_observable || q.gained || q.believed_sigma) << q.name;
  }
  EXPECT_EQ(in_words(report), (std::vector<std::string>{"place: unobservable", "heading: unobservable"}));
}

TEST(ObservabilityReport, JacobiansThatMoveLearnTheHeadingAndNotThePlace) {
  const ObservabilityReport report = Drive(0.02).report();
  EXPECT_EQ(report.ideal_nullity, 3);
  EXPECT_EQ(report.information.nullity(), 2);
  EXPECT_EQ(report.wrongly_believed, 1);
  EXPECT_FALSE(quantity(report, "x").believed_sigma || quantity(report, "y").believed_sigma);
  const QuantityReport heading = quantity(report, "heading");
  EXPECT_TRUE(heading.gained);
  EXPECT_FALSE(heading.ideally_observable);
  EXPECT_NE(in_words(report)[1].find("heading: unobservable, yet the filter believes to know it to "),
            std::string::npos);
  EXPECT_LT(*quantity(Drive(0.04).report(), "heading").believed_sigma, *heading.believed_sigma);
}

TEST(ObservabilityReport, OneAnchorLeavesATurnAndTwoNothing) {
  const ObservabilityReport one = Drive(0, 1).report();
  EXPECT_EQ(one.ideal_nullity, 1);
  EXPECT_EQ(one.information.nullity(), 1);
  EXPECT_EQ(one.wrongly_believed, 0);
  EXPECT_EQ(in_words(one)[1], "heading: unobservable with 1 anchor");
  const ObservabilityReport two = Drive(0, 2).report();
  EXPECT_EQ(two.ideal_nullity, 0);
  EXPECT_EQ(two.information.nullity(), 0);
  for (const QuantityReport& q : two.quantities) EXPECT_TRUE(q.ideally_observable && q.gained) << q.name;
  EXPECT_EQ(in_words(two),
            (std::vector<std::string>{"place: fixed by 2 anchors", "heading: fixed by 2 anchors"}));
}

TEST(ObservabilityReport, WhatIsNotFollowedIsNotBelieved) {
  Drive drive(0, 2);
  const ObservabilityReport report = observability_report({}, drive.scene, drive.fixed, "the map moves");
  EXPECT_EQ(report.ideal_nullity, 0);
  EXPECT_EQ(report.information.errors, 0);
  EXPECT_FALSE(quantity(report, "heading").believed_sigma);
  EXPECT_EQ(in_words(report).back(), "what the filter believes of these is not worked out: the map moves");
}

// A camera
// ---------------------------------------------------------------------------------------------------------

/// A camera that turns and moves steadily, or stands still, and sees points: some of them known, the others
/// born with inverse depth. All Jacobians at the truth.
class Path {
 public:
  Path(int known, bool moves, int steps = 20) {
    scene_.camera[3] = 1;
    if (moves) scene_.camera.tail<6>() << 0.3, 0.1, 0.05, 0.02, -0.03, 0.05;
    for (int i = 0; i < known; ++i) look_at(i, true);
    for (int i = known; i < 8; ++i) give_birth(i);
    for (int step = 0; step < steps; ++step) {
      move();
      for (int i = 0; i < 8; ++i) look_at(i, i < known);
    }
    scene_.errors = monitor_.errors();
    for (auto& landmark : scene_.landmarks)
      landmark.first = monitor_.find(static_cast<BlockId>(landmark.id + 1))->first;
    fixed_.anchors = known;
    fixed_.places.resize(3, known);
    for (int i = 0; i < known; ++i) fixed_.places.col(i) = point(i);
  }
  ObservabilityReport report() { return observability_report(monitor_.information(), scene_, fixed_); }

 private:
  static Vector3d point(int i) { return {0.5 * (i % 3) - 0.5, 0.4 * (i / 3) - 0.3, 2 + 0.3 * (i % 4)}; }
  void move() {
    const auto step = FreeCameraMotion{}.step(scene_.camera, Eigen::Matrix<double, 6, 1>::Zero(), 1.0 / 30);
    AffineMotion motion;
    motion.block = vehicle;
    motion.A = step.F;
    motion.N = step.G * step.G.transpose();
    monitor_.move(motion);
    scene_.camera = step.x;
  }
  void give_birth(int i) {
    const auto pixel = PointLandmark::look(camera_, scene_.camera, point(i))->pixel;
    const auto born = InverseDepthLandmark::birth(camera_, scene_.camera, pixel, 1 / point(i).z());
    BlockBirth birth;
    birth.block = static_cast<BlockId>(i + 1);
    birth.parents.push_back({vehicle, born->Jv});
    Eigen::Matrix<double, 6, 6> noise = 0.16 * born->Jz * born->Jz.transpose();
    noise.topLeftCorner<3, 3>() += 1e-8 * Eigen::Matrix3d::Identity();
    noise(5, 5) += 0.25;
    birth.noise = noise;
    monitor_.give_birth(birth);
    SpatialScene::Landmark& landmark = scene_.landmarks.emplace_back();
    landmark.id = i;
    landmark.form = SpatialScene::Landmark::Form::inverse_depth;
    landmark.birth_axes.world_from_birth = born->world_from_birth;
    landmark.mean = born->landmark;
  }
  void look_at(int i, bool known) {
    AffineLook look;
    if (known) {
      look.add(vehicle, PointLandmark::look(camera_, scene_.camera, point(i))->Hv);
    } else {
      for (const auto& landmark : scene_.landmarks) {
        if (landmark.id != i) continue;
        const auto seen = landmark.birth_axes.look(camera_, scene_.camera, landmark.mean);
        look.add(vehicle, seen->Hv);
        look.add(static_cast<BlockId>(i + 1), seen->Hl);
      }
    }
    look.residual = Vector2d::Zero();
    look.R = 0.16 * Eigen::Matrix2d::Identity();
    monitor_.look(look);
  }

  Camera camera_ = WideAngleCamera{};
  ObservabilityMonitor monitor_{vehicle, 12};
  SpatialScene scene_;
  FixedPoints fixed_;
};

TEST(ObservabilityReport, AMovingCameraLacksWhatItsAnchorsDoNotFix) {
  const int ideal[] = {7, 4, 1, 1, 0};  // the first three points are on a line
  for (int known = 0; known <= 4; ++known) {
    const ObservabilityReport report = Path(known, true).report();
    EXPECT_EQ(report.ideal_nullity, ideal[known]) << known;
    EXPECT_EQ(report.information.nullity(), ideal[known]) << known;
    EXPECT_FALSE(report.information.ambiguous) << known;
    EXPECT_EQ(report.wrongly_believed, 0) << known;
    EXPECT_TRUE(report.without_information.empty()) << report.without_information.front();
    const QuantityReport scale = quantity(report, "scale");
    EXPECT_EQ(scale.ideally_observable, known >= 2) << known;
    EXPECT_EQ(scale.gained, known >= 2) << known;
  }
}

TEST(ObservabilityReport, TheScaleSaidPlainly) {
  EXPECT_EQ(in_words(Path(4, true).report())[2], "scale: fixed by 4 anchors");
  EXPECT_EQ(in_words(Path(0, true).report())[2], "scale: unobservable");
  EXPECT_EQ(in_words(Path(1, true).report())[2], "scale: unobservable with 1 anchor");
}

// Depths and scale are one direction: eight depths unknown are seven and the scale
TEST(ObservabilityReport, ACameraThatStandsStillLearnsNoDepths) {
  const ObservabilityReport free = Path(0, false).report();
  EXPECT_EQ(free.information.nullity(), 6 + 8);
  EXPECT_EQ(free.wrongly_believed, 0);
  ASSERT_EQ(free.without_information.size(), 8u);
  EXPECT_EQ(free.without_information[0], "depth of landmark 0");
  const ObservabilityReport anchored = Path(4, false).report();
  EXPECT_EQ(anchored.information.nullity(), 4);
  EXPECT_EQ(anchored.without_information.size(), 4u);
  EXPECT_EQ(in_words(anchored)[2], "scale: fixed by 4 anchors");
  EXPECT_EQ(
      in_words(anchored).back(),
      "nothing learnt so far of: depth of landmark 4, depth of landmark 5, depth of landmark 6, depth of "
      "landmark 7");
}

TEST(ObservabilityReport, RatesAreNotKnownBeforeTheSecondLook) {
  const ObservabilityReport report = Path(4, true, 0).report();
  EXPECT_EQ(report.without_information[0], "velocity");
  EXPECT_EQ(report.without_information[1], "angular rate");
  EXPECT_TRUE(quantity(report, "x").gained);
}

// Ranks
// ---------------------------------------------------------------------------------------------------------

TEST(ObservabilityReport, ARankNearRoundingIsSaidToBeUnclear) {
  Eigen::VectorXd values(4);
  values << 1e6, 1e3, 1, 0;
  const Eigen::VectorXd units = Eigen::VectorXd::Ones(4);
  const InformationRank clear = rank_of_information(values.asDiagonal(), units);
  EXPECT_EQ(clear.rank, 3);
  EXPECT_EQ(clear.nullity(), 1);
  EXPECT_FALSE(clear.ambiguous);
  values[2] = 3 * clear.tolerance;
  EXPECT_TRUE(rank_of_information(values.asDiagonal(), units).ambiguous);
  values[2] = 1e15;  // rounding then hides as much as is worth knowing
  EXPECT_TRUE(rank_of_information(values.asDiagonal(), units).ambiguous);
}

}  // namespace
}  // namespace incognita
