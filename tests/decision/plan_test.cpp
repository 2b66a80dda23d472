// Plans of motion and gaze: actions, imagined covariance, what is left to map, comparison in parts.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <vector>

#include "incognita/decision/image_expectation.hpp"
#include "incognita/decision/plan/action_paths.hpp"
#include "incognita/decision/plan/cost_to_go.hpp"
#include "incognita/decision/plan/expected_surface.hpp"
#include "incognita/decision/plan/planned_choice.hpp"
#include "incognita/decision/plan/planner.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "tests/saved_state.hpp"

namespace incognita {
namespace {

constexpr double expected_var_m2 = 1.5;
const WorldBounds room{{-2.5, -2.5, 0.4}, {2.5, 2.5, 2.1}};

/// A camera at 1 m height that faces +x, points 2 to 3 m ahead, and landmarks that are expected elsewhere.
struct Scene {
  Estimate estimate;
  BlockVector camera = CameraState::Zero();
  std::vector<ExpectedLandmark> unmapped;

  explicit Scene(int landmarks) {
    camera.segment<4>(3) = level_gaze(0);
    camera[2] = 1;
    FreeCameraMotion::Jacobian P = 1e-4 * FreeCameraMotion::Jacobian::Identity();
    estimate.bodies.emplace_back().block =
        estimate.belief.add_vehicle(FreeCameraMotion::chart, CameraState(camera), P);
    estimate.started = true;
    RandomStream random(7, "test");
    for (int i = 0; i < landmarks; ++i) {
      Landmark landmark{};
      landmark.camera = 0;
      landmark.id = new_id(estimate);
      const Eigen::Vector3d at(2 + random.uniform(), random.uniform() - 0.5, random.uniform() + 0.5);
      const double sigma = 0.01 + 0.1 * random.uniform();
      landmark.block =
          estimate.belief.augment(PointLandmark::chart, at, {}, sigma * sigma * Eigen::Matrix3d::Identity());
      estimate.landmarks.emplace(landmark.id, landmark);
    }
  }
};

/// What one camera measures, and nothing else.
class OneCamera final : public Expectation {
 public:
  explicit OneCamera(const Scene& scene) : camera_(WideAngleCamera{}, CameraSlamSettings{}, false) {
    camera_.prepare(scene.estimate, scene.unmapped, expected_var_m2);
  }
  void expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const override {
    measurements.clear();
    camera_.add(state, measurements);
  }

 private:
  ImageExpectation camera_;
};

JointActions actions_of(double gaze_rate_rad_s, double max_elevation_rad) {
  return JointActions(translations_of(DecisionSettings{}), 1, gaze_rate_rad_s, max_elevation_rad, room);
}

/// Direction of a turn: 1 to the left, -1 to the right.
int turns_left(int turn) { return static_cast<int>(std::lround(actions_of(1, 0.8).rates_of(turn).x())); }

struct Comparison {
  const Scene& scene;
  JointActions actions = actions_of(1.2, 0.8);
  Growth growth = growth_over(0.5, 0.3, 0.3);
  OneCamera expectation{scene};

  Planner::Input now() const {
    return {scene.estimate,
            0,
            scene.camera,
            actions,
            growth,
            expectation,
            scene.unmapped,
            expected_var_m2,
            [](const BlockVector&) { return true; }};
  }
};

TEST(JointActions, AreEachTranslationWithEachTurn) {
  const JointActions level = actions_of(0.4, 0), all = actions_of(0.4, 0.8);
  EXPECT_EQ(level.count(), 7 * 3);
  EXPECT_EQ(all.count(), 7 * 9);
  EXPECT_EQ(all.names()[static_cast<std::size_t>(all.stay()) + 3], "stay_turning_up");
  const Scene scene(0);
  EXPECT_EQ(all.along(scene.camera, all.stay(), 1), scene.camera);
}

TEST(JointActions, TurnAtTheirRatesUpToTheLargestElevation) {
  const JointActions actions = actions_of(0.4, 0.5);
  const Scene scene(0);
  const auto gaze = [](const BlockVector& state) { return Eigen::Vector4d(state.segment<4>(3)); };
  const BlockVector left = actions.along(scene.camera, actions.stay() + 1, 0.5),
                    up = actions.along(scene.camera, actions.stay() + 3, 1),
                    highest = actions.along(up, actions.stay() + 3, 1);
  EXPECT_NEAR(heading_of(gaze(left)), 0.2, 1e-9);
  EXPECT_NEAR(elevation_of(gaze(up)), 0.4, 1e-9);
  EXPECT_NEAR(elevation_of(gaze(highest)), 0.5, 1e-9);
}

TEST(TimeToView, IsThatOfTheLongerOfMotionAndTurn) {
  const Eigen::Vector3d at(0, 0, 1), ahead(1, 0, 0);
  const Reach reach{.speed_m_s = 0.5, .turn_rate_rad_s = 0.4, .half_view_rad = 0.5, .distance_m = 3};
  EXPECT_EQ(time_to_view_s(at, ahead, {0, {2, 0, 1}}, reach), 0);
  EXPECT_NEAR(time_to_view_s(at, ahead, {0, {5, 0, 1}}, reach), 2 / 0.5, 1e-9);
  EXPECT_NEAR(time_to_view_s(at, ahead, {0, {-2, 0, 1}}, reach), (M_PI - 0.5) / 0.4, 1e-9);
}

TEST(TimeToView, LeadsToWhereASurfaceIsNotSeenAlongIt) {
  const Eigen::Vector3d at(0, 0, 1), ahead(1, 0, 0);
  // The floor, 1 m below, is seen under 30 degrees or more up to sqrt(3) m away
  EXPECT_NEAR(time_to_view_s(at, ahead, {0, {2.5, 0, 0}, {0, 0, 1}}, {.speed_m_s = 1, .distance_m = 3}),
              2.5 - std::sqrt(3.0), 1e-9);
}

TEST(ImaginedMap, IsCorrectedLikeTheJointGaussian) {
  const Scene scene(6);
  const OneCamera expectation(scene);
  std::vector<PredictedMeasurement> measurements;
  expectation.expect(scene.camera, measurements);
  ASSERT_EQ(measurements.size(), 6u);
  std::vector<BlockId> blocks;
  for (const auto& m : measurements) blocks.push_back(m.block);
  PlannedMap map;
  map.start(scene.estimate, 0, blocks, expected_var_m2);
  Eigen::MatrixXd information = map.covariance().inverse();
  for (const auto& m : measurements) {
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, information.rows());
    H.leftCols(m.Hv.cols()) = m.Hv;
    H.middleCols(map.row_of(m.block), 3) = m.Hl;
    information += H.transpose() * m.R.inverse() * H;
  }
  ImaginedMap imagined(map);
  imagined.update(map, measurements);
  const Eigen::MatrixXd P = information.inverse();
  EXPECT_NEAR(imagined.entropy_of_pose({0, 0}), std::log(P.topLeftCorner<6, 6>().determinant()) / 2, 1e-6);
}

TEST(InformationToGo, IsLessTheFartherAndNothingOnceKnown) {
  Scene scene(0);
  PlannedMap map;
  map.start(scene.estimate, 0, {}, expected_var_m2);
  const ImaginedMap imagined(map);
  const Eigen::Matrix3d R = rotation_matrix<double>(Eigen::Vector4d(scene.camera.segment<4>(3)));
  const auto to_go = [&](const ExpectedLandmark& landmark) {
    return information_to_go(scene.camera, std::vector{landmark}, map, imagined, {}, {.distance_m = 3}, 1,
                             10);
  };
  const auto missing = [&](const Eigen::Vector3d& at) {
    return imagined.missing_about(map, 0, at - scene.camera.head<3>(), R, {});
  };
  const double near = to_go({0, {2, 0, 1}}), far = to_go({0, {6, 0, 1}});
  EXPECT_GT(near, far);
  EXPECT_NEAR(near, missing({2, 0, 1}) * std::exp(-1 / 10.0), 1e-9);
  EXPECT_NEAR(far, missing({6, 0, 1}) * std::exp(-(1 + 3 / 0.3) / 10), 1e-9);
  EXPECT_NEAR(to_go({0, {2, 0, 1}, {0, 0, 0}, 0.5}), near / 2, 1e-9) << "as probable as not";
  PlannedMap precise;
  precise.start(scene.estimate, 0, {}, 1e-6);
  EXPECT_EQ(information_to_go(scene.camera, std::vector{ExpectedLandmark{0, {2, 0, 1}}}, precise,
                              ImaginedMap(precise), {}, {}, 1, 10),
            0);
}

/// What is viewed from a pose that is not known well is not mapped well.
TEST(ImaginedMap, MissesLessAboutALandmarkTheLessThePoseIsKnown) {
  Scene scene(0);
  PlannedMap map;
  map.start(scene.estimate, 0, {}, expected_var_m2);
  ImaginedMap imagined(map);
  const auto missing = [&](const Eigen::Vector3d& way) {
    return imagined.missing_about(map, 0, way, Eigen::Matrix3d::Identity(), {});
  };
  const double before = missing({2, 0, 0});
  EXPECT_GT(before, missing({6, 0, 0})) << "errors of the orientation count by the distance";
  BlockMatrix A = BlockMatrix::Identity(12, 12), N = BlockMatrix::Zero(12, 12);
  N.diagonal().head<6>().setConstant(0.1 * 0.1);
  imagined.predict(A, N);
  EXPECT_LT(missing({2, 0, 0}), before);
}

/// Its covariance is that of where it was, and its measurement would be predicted from where it is.
TEST(PlannedMap, LeavesOutLandmarksThatMoved) {
  Scene scene(2);
  std::vector<BlockId> blocks;
  for (const auto& [id, landmark] : scene.estimate.landmarks) blocks.push_back(landmark.block);
  PlannedMap map;
  map.start(scene.estimate, 0, blocks, expected_var_m2);
  const SmallVector moved = scene.estimate.belief.mean(blocks[0]) + Eigen::Vector3d(0.1, 0, 0);
  scene.estimate.belief.replace(blocks[0], PointLandmark::chart, moved, SmallMatrix::Identity(3, 3),
                                SmallMatrix::Zero(3, 3));
  map.leave_out_moved(scene.estimate);
  EXPECT_EQ(map.row_of(blocks[0]), -1);
  EXPECT_GE(map.row_of(blocks[1]), 0);
}

/// An error that the whole map shares counts for each of its landmarks, also for those that a plan does not follow.
TEST(PlannedMap, SomeLandmarksStandForTheRestOfTheMap) {
  const Scene scene(7);
  const std::vector<BlockId> followed{scene.estimate.landmarks.begin()->second.block};
  const auto weights = [&](int others) {
    PlannedMap map;
    map.start(scene.estimate, 0, followed, expected_var_m2, others);
    std::vector<double> found;
    for (const PlannedMap::Taken& landmark : map.taken()) found.push_back(landmark.weight);
    return found;
  };
  EXPECT_EQ(weights(0), (std::vector<double>{1}));
  EXPECT_EQ(weights(2), (std::vector<double>{1, 3, 3}));
  EXPECT_EQ(weights(100), std::vector<double>(7, 1));
}

/// A view corrects the imagined estimate by few landmarks of the map, but by every anchor.
TEST(Planner, CountsOnEveryAnchorInView) {
  Scene scene(20);
  const auto score_of_staying = [&] {
    const Comparison comparison{scene};
    Planner planner({.max_measured = 2, .min_matches = 0});
    planner.begin(comparison.now(), std::nullopt);
    planner.choose(comparison.now());
    return planner.scores()[static_cast<std::size_t>(comparison.actions.stay())];
  };
  const double without = score_of_staying();
  for (const double y : {-0.3, 0.3}) {
    Landmark anchor{};
    anchor.fixed = true;
    anchor.camera = 0;
    anchor.id = new_id(scene.estimate);
    anchor.position = Eigen::Vector3d(2, y, 1);
    scene.estimate.landmarks.emplace(anchor.id, anchor);
  }
  EXPECT_GT(score_of_staying(), without + 1);
}

TEST(Planner, TurnsToWhatIsUnmapped) {
  Scene scene(12);
  for (int i = 0; i < 5; ++i) scene.unmapped.push_back({i, {0.3 * i, 3, 1}});  // to the left
  const Comparison comparison{scene};
  Planner planner({.min_matches = 0});
  planner.begin(comparison.now(), std::nullopt);
  const int action = planner.choose(comparison.now());
  EXPECT_EQ(turns_left(action % 9), 1) << comparison.actions.names()[static_cast<std::size_t>(action)];
}

TEST(Planner, KeepsEnoughLandmarksInView) {
  Scene scene(12);
  for (int i = 0; i < 20; ++i) scene.unmapped.push_back({i, {0.1 * i, 2, 1}});
  Comparison comparison{scene};
  comparison.actions = actions_of(1.57, 0.8);  // one turn leads away from all that is mapped
  for (const int least : {0, 8}) {
    Planner planner({.min_matches = least});
    planner.begin(comparison.now(), std::nullopt);
    const int turn = planner.choose(comparison.now()) % 9;
    if (least == 0)
      EXPECT_EQ(turns_left(turn), 1);
    else
      EXPECT_EQ(turns_left(turn), 0);
  }
}

TEST(Planner, ComparesInPartsAsAtOnce) {
  Scene scene(10);
  scene.unmapped = {{0, {1, 3, 1}}, {1, {2, -3, 2}}};
  const Comparison comparison{scene};
  const Planner::UnderWay forward{0, 0.5};
  Planner at_once({}), in_parts({});
  at_once.begin(comparison.now(), forward);
  in_parts.begin(comparison.now(), forward);
  for (int i = 0; i < 20; ++i) in_parts.imagine(comparison.now(), 3);
  EXPECT_EQ(in_parts.choose(comparison.now()), at_once.choose(comparison.now()));
  EXPECT_EQ(in_parts.scores(), at_once.scores());
  EXPECT_FALSE(in_parts.has_begun());
}

TEST(Planner, GoesOnAfterItWasRestored) {
  Scene scene(10);
  scene.unmapped = {{0, {1, 3, 1}}, {1, {2, -3, 2}}};
  const Comparison comparison{scene};
  Planner planner({}), restored({});
  planner.begin(comparison.now(), Planner::UnderWay{0, 0.5});
  planner.imagine(comparison.now(), 11);
  testing::restore(restored, planner);
  EXPECT_EQ(restored.choose(comparison.now()), planner.choose(comparison.now()));
  EXPECT_EQ(restored.scores(), planner.scores());
}

TEST(Planner, BeginsWhereTheActionUnderWayIsToEnd) {
  Scene scene(12);
  const Comparison comparison{scene};
  Scene there = scene;
  there.camera.x() = 0.7;
  const Comparison comparison_there{there};
  Planner planner({.views_per_period = 1, .discount_s = 0}),
      at_its_end({.views_per_period = 1, .discount_s = 0});
  planner.begin(comparison.now(),
                Planner::UnderWay{comparison.actions.stay(), 0.3, Eigen::Vector3d(0.7, 0, 1)});
  at_its_end.begin(comparison_there.now(), std::nullopt);
  planner.choose(comparison.now());
  at_its_end.choose(comparison_there.now());
  for (std::size_t i = 0; i < planner.scores().size(); ++i)
    EXPECT_NEAR(planner.scores()[i], at_its_end.scores()[i], 1e-9);
}

TEST(Planner, AvoidsWhatBecameKnownAfterAnActionWasImagined) {
  const Scene scene(12);
  const Comparison comparison{scene};
  const auto end_of = [&](int action) -> Eigen::Vector3d {
    return comparison.actions.along(scene.camera, action, 1).head<3>();
  };
  Planner free({.min_matches = 0}), stopped({.min_matches = 0});
  free.begin(comparison.now(), std::nullopt);
  const Eigen::Vector3d best = end_of(free.choose(comparison.now()));
  stopped.begin(comparison.now(), std::nullopt);
  stopped.imagine(comparison.now(), comparison.actions.count());
  Planner::Input now = comparison.now();
  now.is_clear = [&](const BlockVector& state) { return (state.head<3>() - best).norm() > 0.1; };
  EXPECT_GT((end_of(stopped.choose(now)) - best).norm(), 0.1);
}

TEST(PlanWorth, WithoutAFiniteScoreIsTheWorst) {
  const PlanWorth bad{.score = std::numeric_limits<double>::quiet_NaN()}, good{.score = -5};
  EXPECT_TRUE(is_better(good, bad));
  EXPECT_FALSE(is_better(bad, good));
}

/// Without discount and pose, more views can only add to the score.
TEST(Planner, LooksFartherWithMoreLevels) {
  Scene scene(10);
  scene.unmapped = {{0, {1, 3, 1}}};
  const Comparison comparison{scene};
  Planner near({.pose_weight = 0, .discount_s = 0}),
      far({.held_periods = {1, 2}, .max_evaluations = 200, .pose_weight = 0, .discount_s = 0});
  near.begin(comparison.now(), std::nullopt);
  far.begin(comparison.now(), std::nullopt);
  near.choose(comparison.now());
  const auto chosen = static_cast<std::size_t>(far.choose(comparison.now()));
  EXPECT_GT(far.scores()[chosen], near.scores()[chosen] + 0.1);
  EXPECT_GT(far.evaluations(), comparison.actions.count());
  EXPECT_LE(far.evaluations(), 200);
}

/// Probabilities fall from tick to tick, and actions imagined later must not be at a disadvantage.
TEST(Planner, RatesAllActionsByTheSameExpectedLandmarks) {
  Scene scene(10);
  scene.unmapped = {{0, {1, 3, 1}}, {1, {2, -3, 2}}};
  const Comparison comparison{scene};
  Planner at_once({}), in_parts({});
  at_once.begin(comparison.now(), std::nullopt);
  at_once.choose(comparison.now());
  in_parts.begin(comparison.now(), std::nullopt);
  for (int i = 0; i < 10; ++i) {
    in_parts.imagine(comparison.now(), 5);
    scene.unmapped[0].probability *= 0.8;
  }
  in_parts.choose(comparison.now());
  EXPECT_EQ(in_parts.scores(), at_once.scores());
}

/// A turn of the world about z that the estimate of body and map share: no measurement of one by the other reduces it.
void share_turn(Scene& scene, double sigma_rad) {
  AnyBelief& belief = scene.estimate.belief;
  const BlockId body = scene.estimate.bodies[0].block;
  const Eigen::Matrix3d R = rotation_matrix<double>(Eigen::Vector4d(scene.camera.segment<4>(3)));
  const Eigen::Vector3d up = R.transpose().col(2);
  SmallMatrix N = 1e-8 * SmallMatrix::Identity(12, 12), A = SmallMatrix::Identity(12, 12);
  N.block<3, 3>(3, 3) += sigma_rad * sigma_rad * up * up.transpose();
  belief.replace(body, FreeCameraMotion::chart, SmallVector(scene.camera), SmallMatrix::Zero(12, 12), N);
  std::vector<ErrorShear> shears;
  for (const auto& [id, landmark] : scene.estimate.landmarks) {
    const SmallVector at = belief.mean(landmark.block);
    belief.replace(landmark.block, PointLandmark::chart, at, SmallMatrix::Zero(3, 3),
                   1e-6 * SmallMatrix::Identity(3, 3));
    shears.push_back({landmark.block, -skew<double>(Eigen::Vector3d(at)) * R});
  }
  belief.shear(body, 3, shears);
  A.block<3, 3>(0, 3) = -skew<double>(Eigen::Vector3d(scene.camera.head<3>())) * R;
  belief.replace(body, FreeCameraMotion::chart, SmallVector(scene.camera), A, SmallMatrix::Zero(12, 12));
}

TEST(Planner, DoesNotExpectTurnsToReduceAnErrorThatBodyAndMapShare) {
  Scene scene(12);
  share_turn(scene, 0.02);
  Comparison comparison{scene};
  comparison.actions = actions_of(0.4, 0.8);
  Planner planner({.min_matches = 0, .pose_weight = 0, .discount_s = 0});
  planner.begin(comparison.now(), std::nullopt);
  planner.choose(comparison.now());
  for (std::size_t action = 0; action < planner.scores().size(); ++action)
    EXPECT_LT(planner.scores()[action], 0.1) << comparison.actions.names()[action];
}

TEST(DriveActions, GoOnAsTheyBegan) {
  const CarrierSettings carrier{{}, 0.3, 0.3};
  const SpeedChanges changes(speed_changes_of(DecisionSettings{}), 1, growth_over(1, 0.3, 0.3), room,
                             carrier.mount, carrier.max_speed_m_s, carrier.max_turn_rate_rad_s);
  const DriveActions actions(changes);
  const Scene scene(0);
  BlockVector state(scene.camera.size() + 2);
  state << scene.camera, 0.1, -0.2;
  for (int action = 0; action < actions.count(); ++action) {
    const BlockVector half = actions.along(state, action, 0.5);
    EXPECT_TRUE(
        actions.along(half, actions.then(action), 0.5).isApprox(actions.along(state, action, 1), 1e-12));
  }
}

Mobility slow() {
  Mobility mobility;
  mobility.step_m = 0.3;
  mobility.speed_m_s = 0.3;
  mobility.turn_rate_rad_s = 0.4;
  return mobility;
}

DecisionSettings planned() {
  DecisionSettings settings;
  settings.strategy = DecisionSettings::Strategy::plan;
  settings.gaze_rate_rad_s = 0.4;
  settings.max_elevation_rad = 0.8;
  return settings;
}

/// Ticks of 0.1 s from `first` on, of a body that the estimate leaves where it is; the chosen actions.
std::vector<int> chosen_in(BodyChoice& choice, const Scene& scene, int first, int ticks) {
  const OneCamera expectation(scene);
  Surroundings around;
  around.estimate = &scene.estimate;
  around.unmapped = scene.unmapped;
  around.expected_var_m2 = expected_var_m2;
  std::vector<int> chosen;
  BodyGoal goal;
  for (int i = first; i < first + ticks; ++i) {
    choice.choose(scene.estimate.belief, scene.estimate.bodies[0], expectation, around, Tick{i, i * 0.1, 0.1},
                  goal);
    if (goal.decided) chosen.push_back(goal.chosen);
  }
  return chosen;
}

/// Saved in the middle of a comparison.
template <class Choice>
void expect_to_go_on(Choice choice, Choice restored) {
  Scene scene(12);
  scene.unmapped = {{0, {1, 2, 1}}, {1, {2, -2, 2}}};
  EXPECT_EQ(chosen_in(choice, scene, 0, 18).size(), 2u) << "one decision a second";
  testing::restore(restored, choice);
  const std::vector<int> chosen = chosen_in(choice, scene, 18, 25);
  EXPECT_EQ(chosen.size(), 3u);
  EXPECT_EQ(chosen_in(restored, scene, 18, 25), chosen);
}

TEST(PlannedCameraChoice, DecidesOncePerPeriodAndGoesOnWhenRestored) {
  const auto choice = [] { return PlannedCameraChoice(planned(), slow(), 0.3, 0.3); };
  expect_to_go_on(choice(), choice());
}

TEST(PlannedCarrierChoice, DecidesOncePerPeriodAndGoesOnWhenRestored) {
  const auto choice = [] {
    return PlannedCarrierChoice(planned(), CarrierSettings{{}, 0.3, 0.3}, slow(), 0.3, 0.3);
  };
  expect_to_go_on(choice(), choice());
}

TEST(PlannedCameraChoice, ForgetsAComparisonThatHasBegun) {
  Scene scene(12);
  scene.unmapped = {{0, {1, 2, 1}}};
  PlannedCameraChoice choice(planned(), slow(), 0.3, 0.3);
  chosen_in(choice, scene, 0, 8);
  choice.forget();
  scene.unmapped = {{0, {-2, 1, 1}}, {1, {-2, -1, 1}}};
  PlannedCameraChoice fresh(planned(), slow(), 0.3, 0.3);
  const std::vector<int> chosen = chosen_in(choice, scene, 8, 1);
  EXPECT_EQ(chosen.size(), 1u) << "decides at once";
  EXPECT_EQ(chosen, chosen_in(fresh, scene, 8, 1)) << "by what is unmapped now";
}

}  // namespace
}  // namespace incognita
