// An estimator that is restored in the middle of a sequence goes on with the same bits, and its map serves another sequence.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/slam/mapper/saved_estimate.hpp"
#include "tests/scratch.hpp"
#include "tests/slam/scene_with_target.hpp"

namespace incognita {
namespace {

using namespace synthetic;

/// The motion of a hand in front of the wall.
CameraState hand(int k) {
  const double t = k / 30.0;
  return camera_at({0.1 * std::sin(1.5 * t), 0.25 * std::sin(2 * t), 0.1 * std::sin(3 * t)},
                   0.15 * std::sin(1.2 * t));
}

struct Sequence {
  std::map<int, std::shared_ptr<const Image>> images;  ///< rendered once

  std::shared_ptr<const Image> at(int k) {
    auto& image = images[k];
    if (!image) image = wall_with_sheet().shared_view(hand(k));
    return image;
  }
};

Sequence& sequence() {
  static Sequence rendered;
  return rendered;
}

struct Running {
  SlamEstimator estimator;
  Estimate estimate = {};

  void state(StateArchive& archive) {
    estimate_state(archive, estimate);
    archive(estimator);
  }
};

std::string saved(Running& running) {
  StateWriter writer;
  StateArchive{writer}(running);
  return writer.take();
}

void restore(const std::string& bytes, Running& running) {
  StateReader reader(bytes);
  StateArchive{reader}(running);
  EXPECT_EQ(reader.left(), 0u);
}

/// Which images are gray, or missing.
struct Disturbance {
  int gray_from = -1, gray_to = -1, missing = -1;
};

void run(Running& running, int from, int to, const Disturbance& disturbance) {
  for (int k = from; k < to; ++k) {
    const bool gray = k >= disturbance.gray_from && k < disturbance.gray_to;
    const Observation seen = k == disturbance.missing ? seeing(nullptr)
                             : gray                   ? seeing_gray(90)
                                                      : seeing(sequence().at(k));
    running.estimator.update(running.estimate, {}, seen, tick(k));
  }
}

/// Saves after each of these frames, and goes on from there.
void expect_goes_on(const std::function<SlamEstimator()>& built, const std::vector<int>& saves, int frames,
                    const Disturbance& disturbance = {}) {
  Running whole{built()};
  std::map<int, std::string> states;
  int done = 0;
  for (const int k : saves) {
    run(whole, done, k, disturbance);
    states[k] = saved(whole);
    done = k;
  }
  run(whole, done, frames, disturbance);
  const std::string end = saved(whole);
  EXPECT_GT(whole.estimate.landmarks.size(), 8u);
  for (const auto& [k, bytes] : states) {
    Running again{built()};
    restore(bytes, again);
    EXPECT_TRUE(saved(again) == bytes) << "after frame " << k;
    run(again, k, frames, disturbance);
    EXPECT_TRUE(saved(again) == end) << "after frame " << k;
  }
}

const Target& rectangle() {
  static const Target target = sheet_target();
  return target;
}

CameraSlamSettings thirty_features() {
  CameraSlamSettings settings;
  settings.map.wanted_visible = 30;
  return settings;
}

TEST(SavedEstimator, ACameraWithTarget) {
  expect_goes_on([] { return single_camera(camera, rectangle(), thirty_features(), 10, 1); },
                 {0, 1, 2, 9, 20}, 30);
}

TEST(SavedEstimator, ACameraWithoutTarget) {
  expect_goes_on([] { return single_camera(camera, {}, thirty_features(), 10, 1); }, {1, 5, 17}, 30);
}

TEST(SavedEstimator, ALostCamera) {
  expect_goes_on([] { return single_camera(camera, rectangle(), thirty_features(), 10, 1); }, {8, 15, 24, 31},
                 45, {12, 30, 5});
}

TEST(SavedEstimator, WhileItWaitsForItsTarget) {
  expect_goes_on([] { return single_camera(camera, rectangle(), thirty_features(), 10, 1); }, {3, 7}, 15,
                 {0, 5, 7});
}

TEST(SavedEstimator, DepthHypotheses) {
  const auto built = [] {
    CameraSlamSettings settings = few_features();
    settings.initialization.method = InitializationSettings::Method::depth_line;
    settings.initialization.min_corner_strength = 5;
    return single_camera(camera, rectangle(), settings, 10, 1);
  };
  expect_goes_on(built, {1, 12, 25}, 40);
}

TEST(SavedEstimator, ErrorsThatLast) {
  const auto built = [] {
    CameraSlamSettings settings = thirty_features();
    settings.filter.sigma_lasting_px = 0.3;
    settings.filter.adapt_sigma_pixel = false;
    return single_camera(camera, rectangle(), settings, 10, 1);
  };
  expect_goes_on(built, {1, 12}, 25);
}

TEST(SavedEstimator, TheInformationForm) {
  const auto built = [] {
    return single_camera(camera, rectangle(), few_features(), 10, 1, {}, {.form = BeliefForm::information});
  };
  expect_goes_on(built, {1, 12}, 25);
}

TEST(SavedEstimator, ItsMapServesAnotherSequence) {
  const auto built = [] { return single_camera(camera, rectangle(), thirty_features(), 10, 1); };
  Running mapping{built()};
  run(mapping, 0, 45, {});
  Running other{built()};
  restore(saved(mapping), other);
  other.estimator.forget_poses(other.estimate, "elsewhere");
  EXPECT_EQ(other.estimate.status.state, TrackingState::lost);
  EXPECT_EQ(other.estimate.status.reason, "elsewhere");
  int tracked = 0;
  for (int k = 0; k < 20; ++k) {
    const CameraState truth = hand(12 + k);
    other.estimator.update(other.estimate, {}, seeing(sequence().at(12 + k)), tick(k, 0, 7000));
    if (other.estimate.status.state == TrackingState::lost) continue;
    ++tracked;
    EXPECT_LT((other.estimate.body().pose.position - truth.head<3>()).norm(), 0.05) << k;
  }
  EXPECT_GT(tracked, 10);
}

TEST(SavedEstimator, AMapWithoutAStartIsRefused) {
  Running running{single_camera(camera, rectangle(), thirty_features(), 10, 1)};
  EXPECT_EQ(testing::message_of<std::invalid_argument>(
                [&] { running.estimator.forget_poses(running.estimate, "elsewhere"); }),
            "the run was saved before its estimate started: there is no map");
}

TEST(SavedEstimator, EveryTruncationIsRefused) {
  Running running{single_camera(camera, rectangle(), few_features(), 10, 1)};
  run(running, 0, 6, {});
  const std::string bytes = saved(running);
  for (std::size_t size = 0; size < bytes.size(); size += bytes.size() / 200 + 1)
    EXPECT_THROW(restore(bytes.substr(0, size), running), DamagedState) << size;
  restore(bytes, running);
  EXPECT_TRUE(saved(running) == bytes);
}

}  // namespace
}  // namespace incognita
