// Timed paths: consistent derivatives, rest outside their span, and the greatest speed.
#include "incognita/control/paths/reference_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "incognita/control/paths/path_speed.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/heading.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using Eigen::Vector3d;
using testing::message_of;
constexpr double pi = std::numbers::pi;

PathSamples wandering(std::uint64_t seed, int n, bool headings) {
  RandomStream random(seed, "samples");
  PathSamples samples;
  double t = random.uniform(-5, 5);
  for (int i = 0; i < n; ++i) {
    samples.t.push_back(t += random.uniform(0.3, 2));
    samples.position.emplace_back(random.normal(), random.normal(), random.normal());
    if (headings) samples.heading.push_back(random.uniform(-pi, pi));
  }
  return samples;
}

const WayPointPath way_points{{{0, 0, 1}, {2, 0, 1}, {2, 0, 1}, {2, 0, 2}, {2, -3, 1}}, 0.8};

std::vector<Path> every_path() {
  return {PointPath{{1, 2, 3}, 0.4},
          CirclePath{{1, -2, 0.5}, 7, radians(5), 0.3},
          CirclePath{{0, 0, 0}, 2, -1.3, 2},
          BackAndForthPath{{0.1, 0.2, 1.1}, 1.5, radians(15)},
          way_points,
          through(wandering(1, 12, true)),
          through(wandering(2, 9, false)),
          through(wandering(3, 2, true)),
          through(wandering(4, 3, false))};
}

void expect_derivatives(const Reference& before, const Reference& now, const Reference& after, double h) {
  EXPECT_LE(((after.position - before.position) / (2 * h) - now.velocity).norm(), 1e-6);
  EXPECT_LE(((after.velocity - before.velocity) / (2 * h) - now.acceleration).norm(), 1e-4);
  EXPECT_NEAR((after.heading - before.heading) / (2 * h), now.heading_rate, 1e-6);
  EXPECT_NEAR((after.heading_rate - before.heading_rate) / (2 * h), now.heading_acceleration, 1e-4);
}

TEST(ReferencePath, DerivativesEqualDifferences) {
  RandomStream random(1, "times");
  constexpr double h = 1e-5;
  for (const Path& path : every_path()) {
    check(path);
    const PathSpan span = span_of(path);
    const double end = std::min(span.end_s, span.start_s + 60);
    for (int i = 0; i < 300; ++i) {
      const double t = random.uniform(span.start_s + h, end - h);
      const bool turns_on_the_spot =
          std::holds_alternative<WayPointPath>(path) && at(path, t - h).heading != at(path, t + h).heading;
      if (!turns_on_the_spot) expect_derivatives(at(path, t - h), at(path, t), at(path, t + h), h);
    }
  }
}

TEST(ReferencePath, IsAtRestBeforeItsStartAndAfterItsEnd) {
  for (const Path& path : every_path()) {
    const PathSpan span = span_of(path);
    const auto stands = [&](double t, double where) {
      const Reference now = at(path, t), there = at(path, where);
      EXPECT_LE((now.position - there.position).norm(), 1e-12);
      EXPECT_EQ(now.heading, there.heading);
      EXPECT_TRUE(now.velocity.isZero(1e-12) && now.acceleration.isZero(1e-9));
      EXPECT_EQ(now.heading_rate, 0);
      EXPECT_EQ(now.heading_acceleration, 0);
    };
    stands(span.start_s - 3, span.start_s);
    if (!std::isfinite(span.end_s)) continue;
    stands(span.end_s + 5, span.end_s);
    stands(span.end_s, span.end_s);
  }
}

TEST(CirclePath, IsTheThesisCircleWithTheCorrectVelocity) {  // (5.14), and (5.15) with its factor
  const double r = 7, w = radians(5);
  for (const double t : {0.0, 3.0, 100.0}) {
    const Reference reference = at(CirclePath{{0, 0, 0}, r, w, 0}, t);
    EXPECT_LE((reference.position - r * Vector3d(std::cos(w * t), std::sin(w * t), 0)).norm(), 1e-12);
    EXPECT_LE((reference.velocity - r * w * Vector3d(-std::sin(w * t), std::cos(w * t), 0)).norm(), 1e-12);
    const Vector3d gaze(std::cos(reference.heading), std::sin(reference.heading), 0);
    EXPECT_NEAR(gaze.dot(reference.velocity.normalized()), 1, 1e-12);
  }
  const Reference right = at(CirclePath{{0, 0, 0}, r, -w, 0.4}, 2);
  EXPECT_NEAR(std::cos(right.heading) * right.velocity.x() + std::sin(right.heading) * right.velocity.y(),
              r * w, 1e-12);
}

/// (5.28) in the axes of the thesis, transformed into ours, for a camera.
TEST(BackAndForthPath, IsTheThesisPathAndFacesTheCenter) {
  const BackAndForthPath path{{0.3, -0.4, 1.2}, 1.5, radians(15)};
  for (double t = 0; t < 30; t += 0.37) {
    const double p = path.amplitude_rad * (std::sin(2 * t) - 2 * t / pi);
    const Vector3d thesis(path.radius_m * std::sin(p), 0, -path.radius_m * std::cos(p));  // left, up, forward
    const Reference reference = at(path, t);
    EXPECT_LE((reference.position - path.center - Vector3d(thesis.z(), thesis.x(), thesis.y())).norm(),
              1e-12);
    const Eigen::Vector4d gaze = level_gaze(reference.heading);  // w, x, y, z
    const Eigen::Quaterniond world_from_camera(gaze[0], gaze[1], gaze[2], gaze[3]);
    const Vector3d axis = world_from_camera * Vector3d(0, 0, 1);
    EXPECT_LE((axis - (path.center - reference.position) / path.radius_m).norm(), 1e-12);
    EXPECT_NEAR(reference.heading_rate, -path.amplitude_rad * (2 * std::cos(2 * t) - 2 / pi), 1e-12);
  }
  EXPECT_NEAR(at(path, 3 + pi).heading - at(path, 3).heading, 2 * path.amplitude_rad, 1e-12)
      << "not periodic";
}

TEST(WayPointPath, StopsAtEachPointAndFacesItsDirection) {
  const Path path = way_points;
  EXPECT_NEAR(span_of(path).end_s, 15.0 / 8 * (2 + 1 + std::sqrt(10.0)) / 0.8, 1e-12);
  const double first = 15.0 / 8 * 2 / 0.8, second = first + 15.0 / 8 / 0.8;
  EXPECT_TRUE(at(path, first).position.isApprox(Vector3d(2, 0, 1)));
  EXPECT_TRUE(at(path, first).velocity.isZero(1e-12));
  EXPECT_NEAR(at(path, first / 2).velocity.norm(), 0.8, 1e-12);
  EXPECT_EQ(at(path, first / 2).heading, 0);
  EXPECT_EQ(at(path, first + 0.1).heading, 0) << "straight up keeps the heading";
  EXPECT_NEAR(at(path, second + 0.1).heading, -pi / 2, 1e-12);
  EXPECT_TRUE(at(path, 1e6).position.isApprox(Vector3d(2, -3, 1)));
  const Path one = WayPointPath{{{1, 1, 1}}, 1};
  EXPECT_TRUE(at(one, 3).position.isApprox(Vector3d(1, 1, 1)));
  EXPECT_EQ(span_of(one).end_s, 0);
  EXPECT_EQ(greatest_speed(one).m_s, 0);
}

TEST(SampledPath, InterpolatesItsSamplesSmoothly) {
  const PathSamples samples = wandering(7, 20, true);
  const Path path = through(samples);
  EXPECT_EQ(span_of(path).start_s, samples.t.front());
  EXPECT_EQ(span_of(path).end_s, samples.t.back());
  for (std::size_t i = 0; i < samples.t.size(); ++i) {
    const Reference reference = at(path, samples.t[i]);
    EXPECT_LE((reference.position - samples.position[i]).norm(), 1e-12);
    EXPECT_NEAR(wrap_angle(reference.heading - samples.heading[i]), 0, 1e-12);
    if (i == 0 || i + 1 == samples.t.size()) continue;
    const Reference before = at(path, samples.t[i] - 1e-9), after = at(path, samples.t[i] + 1e-9);
    EXPECT_LE((after.velocity - before.velocity).norm(), 1e-6);
    EXPECT_LE((after.acceleration - before.acceleration).norm(), 1e-6);
  }
}

TEST(SampledPath, ConvergesToTheSampledPath) {
  const Path circle = CirclePath{{1, 2, 0}, 2, 0.5, 0};
  PathSamples samples;
  for (double t = 0; t <= 40; t += 0.25) {
    samples.t.push_back(t);
    samples.position.push_back(at(circle, t).position);
  }
  const Path path = through(samples);
  for (double t = 3; t < 37; t += 0.1) {
    EXPECT_LE((at(path, t).position - at(circle, t).position).norm(), 1e-5);
    EXPECT_LE((at(path, t).velocity - at(circle, t).velocity).norm(), 1e-4);
    EXPECT_NEAR(at(path, t).heading, at(circle, t).heading, 1e-3) << "of travel, through three turns";
  }
}

TEST(SampledPath, TurnsTheShorterWayAndKeepsTheHeadingAtRest) {
  PathSamples samples{{0, 1, 2}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {3.1, -3.1, 3.1}};
  EXPECT_LT(std::abs(at(through(samples), 0.5).heading_rate), 0.5);
  samples = {{0, 1, 2, 3, 4}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}};
  EXPECT_EQ(at(through(samples), 2.5).heading, 0);
  samples = {{0, 1}, {{0, 0, 0}, {0, 2, 0}}, {}};
  EXPECT_NEAR(at(through(samples), 0.3).heading, pi / 2, 1e-12);
  EXPECT_TRUE(at(through(samples), 0.3).velocity.isApprox(Vector3d(0, 2, 0)));
}

TEST(GreatestSpeed, IsATightBound) {
  for (const Path& path : every_path()) {
    const PathSpan span = span_of(path);
    const double end = std::min(span.end_s, span.start_s + 100);
    double seen = 0;
    for (int i = 0; i < 20'000; ++i)
      seen = std::max(seen, at(path, span.start_s + (end - span.start_s) * i / 20'000).velocity.norm());
    const PathSpeed greatest = greatest_speed(path);
    EXPECT_GE(greatest.m_s * (1 + 1e-12), seen);
    EXPECT_LE(greatest.m_s, seen * (1 + 1e-5));
    EXPECT_NEAR(at(path, std::min(greatest.t_s, end - 1e-9)).velocity.norm(), greatest.m_s, 1e-6);
  }
}

TEST(Unreachable, StatesTheDemandAndTheLimit) {
  const Path circle = CirclePath{{0, 0, 0}, 7, -0.5, 0};
  EXPECT_EQ(unreachable(circle, 3.5), std::nullopt);
  EXPECT_EQ(unreachable(circle, 2).value_or(""),
            "the path asks for 3.5 m/s at t = 0 s, the vehicle has 2 m/s");
  EXPECT_EQ(unreachable(PointPath{{1e6, 0, 0}}, 0.1), std::nullopt);
  EXPECT_EQ(unreachable(WayPointPath{{{0, 0, 0}, {0, 0, 0}, {4, 0, 0}}, 2}, 1).value_or(""),
            "the path asks for 2 m/s at t = 1.875 s, the vehicle has 1 m/s");
}

TEST(ReferencePath, RefusesInvalidPaths) {
  const auto complaint = [](const Path& path) {
    return message_of<std::invalid_argument>([&] { check(path); });
  };
  EXPECT_HAS(complaint(PointPath{{NAN, 0, 0}}), "the point is not finite");
  EXPECT_HAS(complaint(CirclePath{.radius_m = 0}), "the radius of the path must be positive");
  EXPECT_HAS(complaint(CirclePath{.rate_rad_s = 0}), "the rate of the circle must not be 0");
  EXPECT_HAS(complaint(CirclePath{.phase_rad = INFINITY}), "the phase of the circle is not finite");
  EXPECT_HAS(complaint(BackAndForthPath{.amplitude_rad = NAN}), "the amplitude of the path");
  EXPECT_HAS(complaint(BackAndForthPath{.center = {0, NAN, 0}}), "the center of the path is not finite");
  EXPECT_HAS(complaint(WayPointPath{}), "there are no way-points");
  EXPECT_HAS(complaint(WayPointPath{{{0, 0, 0}}, 0}), "the speed between way-points must be positive");
  EXPECT_HAS(complaint(WayPointPath{{{0, 0, NAN}}, 1}), "a way-point is not finite");
  EXPECT_HAS(complaint(SampledPath{}), "made by through()");
}

TEST(SampledPath, RefusesInvalidSamples) {
  const auto complaint = [](const PathSamples& samples) {
    return message_of<std::invalid_argument>([&] { through(samples); });
  };
  const Vector3d o(0, 0, 0), far(1e300, 0, 0);
  EXPECT_HAS(complaint({}), "a path needs two samples or more");
  EXPECT_HAS(complaint({{0}, {o}, {}}), "there are 1 and 1 times");
  EXPECT_HAS(complaint({{0, 1}, {o, o, o}, {}}), "there are 3 and 2 times");
  EXPECT_HAS(complaint({{0, 1}, {o, o}, {1}}), "2 positions and 1 headings");
  EXPECT_HAS(complaint({{0, 1, 1}, {o, o, o}, {}}), "sample 3 of the path is at 1.0");
  EXPECT_HAS(complaint({{0, NAN}, {o, o}, {}}), "not finite");
  EXPECT_HAS(complaint({{0, 1e-100, 2e-100}, {o, far, o}, {}}), "too far apart");
}

}  // namespace
}  // namespace incognita
