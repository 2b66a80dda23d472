// The uneven floor of the rendered room: intersections with rays, and its images.
#include "incognita/world/rendered/ground.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/world/rendered/render.hpp"

using namespace incognita;

namespace {

const Box inside{{-3, -3, 0}, {3, 3, 2.5}};
const double quarter = std::acos(0.0);

Terrain waves(double amplitude_m, double length_m) {
  return Waves{0, {{amplitude_m, length_m, 0, 0}, {amplitude_m, length_m, quarter, quarter}}};
}

using Ray = std::array<float, 3>;

/// First point of a ray below the terrain itself, by small steps and bisection.
double first_intersection(const Terrain& terrain, const Ray& eye, const Ray& d, double most) {
  const auto gap = [&](double t) {
    return eye[2] + t * d[2] - terrain.at<double>(eye[0] + t * d[0], eye[1] + t * d[1]).height;
  };
  const double step = 1e-3;
  double t = 0;
  while (gap(t + step) > 0)
    if ((t += step) > most) return most;
  double low = t, high = t + step;
  for (int i = 0; i < 40; ++i) (gap(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  return low;
}

TEST(Ground, RaysMeetItWhereTheyFirstEnterTheTerrain) {
  const Terrain terrain = waves(0.12, 1.7);
  const Ground ground(terrain, inside);
  RandomStream random(3, "rays");
  int met = 0, missed = 0;
  for (int i = 0; i < 2000; ++i) {
    const float x = random.uniform(-2, 2), y = random.uniform(-2, 2);
    const Ray eye{x, y, static_cast<float>(terrain.at<double>(x, y).height + random.uniform(0.1, 1.2))};
    const double heading = random.uniform(-3.1, 3.1), down = random.uniform(-0.1, 0.9);
    const Ray d{float(std::cos(heading)), float(std::sin(heading)), float(-down)};
    double most = 1e9;  // distance to the nearest wall
    for (int axis = 0; axis < 2; ++axis)
      if (d[axis] != 0) most = std::min(most, (std::copysign(3.0, d[axis]) - eye[axis]) / d[axis]);
    const double expected = first_intersection(terrain, eye, d, most);
    const double found = ground.meet(eye, d, static_cast<float>(most));
    // Whether a ray hits a crest or grazes it is beyond the resolution of the grid
    const double least_gap = 1e-3;
    if (std::abs(found - expected) > 5e-3) {
      const double t = std::min(found, expected);
      const double gap = eye[2] + t * d[2] - terrain.at<double>(eye[0] + t * d[0], eye[1] + t * d[1]).height;
      EXPECT_LT(std::abs(gap), least_gap) << i << ": " << found << " instead of " << expected;
      ++missed;
    }
    met += found < most;
  }
  EXPECT_GT(met, 1000);
  EXPECT_LT(missed, 20);  // at crests only
}

TEST(Ground, HasTheHeightAndSlopeOfTheTerrain) {
  const Terrain terrain = waves(0.1, 2.5);
  const Ground ground(terrain, inside);
  RandomStream random(4, "places");
  for (int i = 0; i < 500; ++i) {
    const double x = random.uniform(-2.9, 2.9), y = random.uniform(-2.9, 2.9);
    const GroundPoint<double> exact = terrain.at<double>(x, y);
    const Ground::HeightAndSlope place = ground.at(float(x), float(y));
    EXPECT_NEAR(place.height, exact.height, 1e-4);
    EXPECT_NEAR(place.slope_x, exact.x, 0.01);
    EXPECT_NEAR(place.slope_y, exact.y, 0.01);
  }
  EXPECT_NEAR(ground.highest_m(), 0.2, 0.01);
  EXPECT_NEAR(ground.lowest_m(), -0.2, 0.01);
}

TEST(Ground, RefusesTerrainThatDoesNotFitTheRoom) {
  const HeightMap small(Eigen::MatrixXd::Zero(5, 5), 1, {-2, -2});
  EXPECT_THROW(Ground(small, inside), std::invalid_argument);
  EXPECT_THROW(Ground(TiltedPlane{2.2, 0, 0}, inside), std::invalid_argument);
}

const Camera camera{WideAngleCamera{}};

Image picture(const Room& room, const Eigen::Vector3d& position, double heading) {
  Image out;
  render(room, RayTable(camera), position, level_gaze(heading), out);
  return out;
}

double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (int v = 0; v < a.height(); ++v)
    for (int u = 0; u < a.width(); ++u) sum += std::abs(a(u, v) - b(u, v));
  return sum / (a.width() * a.height());
}

// Two algorithms, one image: planes for a flat floor, ray marching for a level terrain.
TEST(Ground, LevelTerrainLooksLikeTheFlatFloor) {
  const Room flat(RoomSettings{}, 1), level(RoomSettings{}, 1, Terrain{});
  for (const double heading : {0.0, 1.3, -2.2}) {
    const Image a = picture(flat, {0.4, -0.3, 1.1}, heading), b = picture(level, {0.4, -0.3, 1.1}, heading);
    double floor = 0;
    int count = 0;
    for (int v = 200; v < 240; ++v)
      for (int u = 0; u < 320; ++u, ++count) floor += std::abs(a(u, v) - b(u, v));
    EXPECT_LT(floor / count, 1.0) << heading;
  }
}

// The texture is fixed to the floor: the image of a raised floor from an equally raised camera must show the
// same floor.
TEST(Ground, ARaisedFloorHasTheSameTexture) {
  const Room level(RoomSettings{}, 1, Terrain{}), raised(RoomSettings{}, 1, Terrain(TiltedPlane{0.3, 0, 0}));
  const Image a = picture(level, {0, -0.3, 1.1}, 0), b = picture(raised, {0, -0.3, 1.4}, 0);
  double floor = 0;
  int count = 0;
  for (int v = 222; v < 240; ++v)
    for (int u = 80; u < 240; ++u, ++count) floor += std::abs(a(u, v) - b(u, v));
  EXPECT_LT(floor / count, 1.0);
  EXPECT_GT(mean_difference(a, b), 1.0);  // the walls have moved
}

TEST(Ground, HillsOccludeWhatIsBehindThem) {
  const Room level(RoomSettings{}, 1, Terrain{});
  // A ridge of 1 m across the room, 1 m ahead of the camera at 0.5 m height
  const Terrain ridge = Waves{0, {{0.5, 4, 0, -quarter}}};
  const Room hidden(RoomSettings{}, 1, ridge);
  const Image a = picture(level, {0, 0, 0.3}, 0), b = picture(hidden, {0, 0, 0.3}, 0);
  EXPECT_GT(mean_difference(a, b), 10);
  EXPECT_EQ(mean_difference(picture(hidden, {2, 0, 0.3}, 0), Image(320, 240)), 0)
      << "a camera below the ground";
}

TEST(Ground, SameSeedSameBytes) {
  const Terrain terrain = waves(0.05, 2.5);
  const Room one(RoomSettings{}, 7, terrain), two(RoomSettings{}, 7, terrain);
  EXPECT_EQ(mean_difference(picture(one, {0, 0, 1}, 0.3), picture(two, {0, 0, 1}, 0.3)), 0);
}

}  // namespace
