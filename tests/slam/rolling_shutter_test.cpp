// The readout time of a rolling shutter, from the residuals of matches.
#include "incognita/slam/features/rolling_shutter.hpp"

#include "incognita/math/random.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita::synthetic {
namespace {

/// A camera that sways and turns before known points, whose rows and columns are read in these times.
std::optional<Readout> found(double of_columns_s, double of_rows_s, double sigma_px = 0.3, int frames = 120) {
  RandomStream random(1, "test.matches");
  Tracking t(camera_at({0, 0, 1}), 1e-4 * CameraCov::Identity());
  t.tracked.sigma_pixel_px = sigma_px;
  for (int i = 0; i < 40; ++i) {
    Landmark landmark;
    landmark.id = i;
    landmark.fixed = true;
    landmark.position =
        Eigen::Vector3d(random.uniform(1.5, 4), random.uniform(-1, 1), random.uniform(0.4, 1.6));
    landmark.first_view = t.tracked.view.camera.head<3>();
    t.estimate.landmarks.emplace(i, landmark);
  }
  constexpr double rate_hz = 30;
  const CameraState start = t.tracked.view.camera;
  const auto at = [&](double time) {
    CameraState x = start;
    x.head<3>() += 0.1 * Eigen::Vector3d(0, std::sin(2 * time), std::sin(3 * time));
    x.segment<4>(3) = quaternion_product<double>(
        x.segment<4>(3),
        quaternion_exp<double>(
            0.2 * Eigen::Vector3d(std::sin(2 * time), std::sin(2.5 * time), std::sin(1.5 * time))));
    return x;
  };
  const Eigen::Array2d size(t.tracked.camera.width(), t.tracked.camera.height());
  RollingShutter shutter;
  for (int frame = 0; frame < frames; ++frame) {
    const double time = frame / rate_hz;
    t.tracked.view.camera = at(time);
    t.tracked.matches.clear();
    for (const auto& [id, landmark] : t.estimate.landmarks) {
      Eigen::Vector2d pixel = pixel_of(at(time), landmark.position);
      // Where it is when its row and column are read: twice, as the row depends on it
      for (int i = 0; i < 2; ++i) {
        const Eigen::Vector2d place = ((pixel.array() + 0.5) / size - 0.5).matrix();
        pixel = pixel_of(at(time + place.dot(Eigen::Vector2d(of_columns_s, of_rows_s))), landmark.position);
      }
      FeatureMatch match{};
      match.id = id;
      match.outcome = MatchOutcome::matched;
      match.measured = pixel + sigma_px * Eigen::Vector2d(random.normal(), random.normal());
      t.tracked.matches.push_back(match);
    }
    shutter.update(t.estimate, t.tracked, time);
  }
  return shutter.readout();
}

TEST(RollingShutter, OfRowsIsFound) {
  const auto readout = found(0, 0.01);
  ASSERT_TRUE(readout);
  EXPECT_FALSE(readout->of_columns);
  EXPECT_NEAR(readout->s, 0.01, 0.002);
}

TEST(RollingShutter, MayBeginWithTheLastRow) {
  const auto readout = found(0, -0.01);
  ASSERT_TRUE(readout);
  EXPECT_NEAR(readout->s, -0.01, 0.002);
}

TEST(RollingShutter, OfAnImageThatWasTurnedIsOfColumns) {
  const auto readout = found(0.01, 0);
  ASSERT_TRUE(readout);
  EXPECT_TRUE(readout->of_columns);
  EXPECT_NEAR(readout->s, 0.01, 0.002);
}

TEST(RollingShutter, IsNotFoundWhereAllRowsAreExposedAtOnce) {
  for (const double sigma_px : {0.05, 0.3, 1.0}) EXPECT_FALSE(found(0, 0, sigma_px)) << sigma_px;
}

TEST(RollingShutter, NeedsEvidence) {
  EXPECT_FALSE(RollingShutter().readout());
  EXPECT_FALSE(found(0, 0.01, 0.3, 2));
}

}  // namespace
}  // namespace incognita::synthetic
