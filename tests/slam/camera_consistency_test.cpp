// The whole single-camera estimator in the rendered room: consistent over seeds, and the same bytes from the
// same seed.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/io/scenario/target_file.hpp"
#include "incognita/math/gaussian.hpp"
#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/world/rendered/room_camera.hpp"
#include "tests/world/camera_in_room.hpp"

namespace incognita {
namespace {

constexpr double rate_hz = 30;

/// The default scenario; one room for all seeds, as painting it takes longest.
struct Setup {
  LoadedScenario loaded = load_scenario("room");
  Camera camera = make_camera(loaded.scenario.camera);
  Target target = load_target(loaded);
  std::shared_ptr<const Room> room = std::make_shared<const Room>(loaded.scenario.room, 1);
};

const Setup& setup() {
  static const Setup shared;
  return shared;
}

/// A sway of 0.3 m to the side and up, and of the gaze, so that depths are seen.
Command sway(double t) {
  FreeCameraMotion::Input<double> input;
  input << 0.1 * std::cos(t), 0.5 * std::cos(2.1 * t), 0.4 * std::cos(2.6 * t + 1), 0, 0.25 * std::cos(2 * t),
      0;
  return {{BodyCommand{input}}};
}

struct Run {
  std::vector<double> nees;  ///< of the pose, 6 degrees of freedom, one each half second
  double most_error_m = 0;
  double nis = 0;  ///< sum over the updates
  int rows = 0;
  int lost_frames = 0, mapped = 0;
  std::string bytes;  ///< of mean and covariance, every tenth frame
};

void append(std::string& bytes, const Eigen::MatrixXd& numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()),
               sizeof(double) * static_cast<std::size_t>(numbers.size()));
}

double pose_nees(const CameraState& truth, const Estimate& estimate) {
  const CameraState x = estimate.camera_state();
  Eigen::Matrix<double, 12, 1> error;
  FreeCameraMotion::chart.minus({truth.data(), 13}, {x.data(), 13}, {error.data(), 12});
  const Eigen::MatrixXd P = estimate.belief.covariance(estimate.body().block).topLeftCorner(6, 6);
  return error.head<6>().dot(P.llt().solve(error.head<6>()));
}

Run run(std::uint64_t seed, double duration_s,
        const CameraSlamSettings& settings = setup().loaded.scenario.slam) {
  const Scenario& scenario = setup().loaded.scenario;
  testing::CameraInRoom camera(scenario.room, setup().room->layout(), seed);
  SensorSet sensors(
      sensors_of_body(std::make_unique<RoomCamera>(setup().room, setup().camera, scenario.room, seed)));
  SlamEstimator estimator =
      single_camera(setup().camera, setup().target, settings, scenario.start.max_search_s, seed);
  Estimate estimate;
  Command command;
  Run run;
  const int frames = static_cast<int>(std::lround(duration_s * rate_hz));
  for (int k = 0; k <= frames; ++k) {
    const Tick tick{k, k / rate_hz, k == 0 ? 0 : 1 / rate_hz};
    const CameraState truth = camera.move(input_of(command_of(command, 0), 6), tick.dt);
    estimator.update(estimate, command, sensors.measure(camera.truth(), tick), tick);
    command = sway(tick.t);
    run.lost_frames += estimate.status.state == TrackingState::lost;
    if (!estimate.started) continue;
    if (estimate.last.update.outcome == UpdateReport::Outcome::updated) {
      run.nis += estimate.last.update.nis;
      run.rows += estimate.last.update.rows;
    }
    run.most_error_m =
        std::max(run.most_error_m, (truth.head<3>() - estimate.camera_state().head<3>()).norm());
    if (k > 0 && k % 15 == 0) run.nees.push_back(pose_nees(truth, estimate));
    if (k % 10 != 0) continue;
    append(run.bytes, estimate.camera_state());
    append(run.bytes, estimate.belief.dense_covariance());
  }
  run.mapped = estimate.mapped_count();
  return run;
}

TEST(CameraConsistency, NeesOfThePoseIsInTheBandOfChiSquare) {
  constexpr int runs = 10;
  std::vector<double> sums;  // over the runs, by time
  for (int seed = 1; seed <= runs; ++seed) {
    const auto made = run(seed, 3);
    EXPECT_EQ(made.lost_frames, 0) << "seed " << seed;
    EXPECT_GE(made.mapped, 6) << "seed " << seed;
    EXPECT_LT(made.most_error_m, 0.08) << "seed " << seed;
    sums.resize(made.nees.size());
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += made.nees[i];
  }
  ASSERT_EQ(sums.size(), 6u);
  for (const double sum : sums) {
    // Runs are independent: at one time they have 60 degrees of freedom together
    EXPECT_LT(sum, chi_square_quantile(0.995, 6 * runs)) << "overconfident";
    // In the first second the filter is conservative: the band of one pose is the least
    EXPECT_GT(sum / runs, chi_square_quantile(0.005, 6)) << "of no use";
  }
}

/// With the noise of room.toml innovations are smaller than predicted, but nearer to it than with 0.4 px of white noise.
/// Where the settings of the scenario come from: docs/consistency.md.
TEST(CameraConsistency, WithLastingErrorsAsStatesNisIsNearerToOne) {
  CameraSlamSettings all_white = setup().loaded.scenario.slam;
  ASSERT_GT(all_white.filter.sigma_lasting_px, 0);
  all_white.filter.sigma_pixel_px = 0.4;
  all_white.filter.sigma_lasting_px = 0;
  double nis = 0, white_nis = 0, nees = 0;
  int rows = 0, white_rows = 0, count = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    const auto made = run(seed, 5), white = run(seed, 5, all_white);
    EXPECT_EQ(made.lost_frames, 0) << "seed " << seed;
    nis += made.nis;
    rows += made.rows;
    white_nis += white.nis;
    white_rows += white.rows;
    for (const double sum : made.nees) nees += sum / 6;
    count += static_cast<int>(made.nees.size());
  }
  // Over 60 s it is 0.7: docs/consistency.md. In the first seconds matches are better, and their white noise is too large
  EXPECT_GT(nis / rows, 0.4) << "NEES " << nees / count << ", white " << white_nis / white_rows;
  EXPECT_LT(nis / rows, 1.25);
  EXPECT_LT(white_nis / white_rows, 0.5 * nis / rows) << "0.4 px of white noise instead";
  EXPECT_LT(nees / count, chi_square_quantile(0.995, 6 * 6) / (6 * 6)) << "overconfident";
}

/// Small noise shows what linearization does: at the start the pose is uncertain across the target, and the first corrections are
/// large. Without invariant errors they seem to show where the world is turned to.
TEST(CameraConsistency, WithInvariantErrorsTheStartIsNotOverconfident) {
  CameraSlamSettings settings = setup().loaded.scenario.slam;
  const auto nees = [&](bool invariant) {
    settings.filter.invariant = invariant;
    double sum = 0;
    int count = 0;
    for (int seed = 1; seed <= 10; ++seed) {
      const auto made = run(seed, 2, settings);
      EXPECT_EQ(made.lost_frames, 0) << "seed " << seed;
      for (const double of_pose : made.nees) sum += of_pose / 6;
      count += static_cast<int>(made.nees.size());
    }
    return sum / count;
  };
  const double with = nees(true), without = nees(false);
  EXPECT_LT(with, 0.8) << "without " << without;
  EXPECT_GT(without, 1.5 * with);
}

TEST(CameraConsistency, TheSameSeedGivesTheSameBytes) {
  const std::string once = run(3, 1).bytes, again = run(3, 1).bytes, other = run(4, 1).bytes;
  ASSERT_GT(once.size(), 1000u);
  EXPECT_TRUE(once == again);
  EXPECT_FALSE(once == other);
}

}  // namespace
}  // namespace incognita
