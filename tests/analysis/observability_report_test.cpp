// Observability reports of vehicle and camera paths with known symmetries.
#include "incognita/analysis/observability/observability_report.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "incognita/analysis/observability/observability_monitor.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/planar_frame.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"

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

MonitoredInformation information_of(ObservabilityMonitor& monitor) {
  return {monitor.information(), monitor.gathered()};
}

// Planar vehicle
// ---------------------------------------------------------------------------------------------------------

/// A circle among landmarks, all measured at every step; Jacobians at the true states or, as in a filter, at
/// states perturbed by `off` anew each time.
struct Drive {
  explicit Drive(double off, int known = 0) {
    RandomStream random(1, "drive");
    const std::vector<Vector2d> points{{5, 3}, {8, -2}, {2, 6}, {12, 4}};
    for (int step = 0; step <= steps; ++step) {
      const planar::Pose<double> here = scene.vehicles[0] + off * perturbation(random);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto prediction =
            RangeBearing::predict_measurement(here, points[i] + off * perturbation(random).head<2>());
        LinearizedMeasurement measurement;
        measurement.add(vehicle, prediction->Hv);
        if (i >= static_cast<std::size_t>(known))
          measurement.add(static_cast<BlockId>(i) + 1, prediction->Hl);
        measurement.residual = Vector2d::Zero();
        measurement.R = Vector2d(0.01, 1e-4).asDiagonal();
        monitor.add_measurement(measurement);
      }
      const planar::Pose<double> next =
          DifferentialDrive{}.f<double>(here, {0.5 + 0.1 * random.normal(), 0.1 + 0.1 * random.normal()}, 1);
      LinearizedMotion motion;
      motion.block = vehicle;
      motion.A = planar::jacobian_between(here, next);
      motion.N = Vector3d(1e-3, 1e-3, 1e-4).asDiagonal();
      monitor.move(motion);
      scene.vehicles[0] = next;
    }
    for (std::size_t i = static_cast<std::size_t>(known); i < points.size(); ++i)
      scene.landmarks.push_back(
          {static_cast<std::int64_t>(i), monitor.find(static_cast<BlockId>(i) + 1)->first, points[i]});
    scene.errors = monitor.errors();
    fixed.anchors = known;
    fixed.positions.resize(2, known);
    for (int i = 0; i < known; ++i) fixed.positions.col(i) = points[static_cast<std::size_t>(i)];
  }
  static planar::Pose<double> perturbation(RandomStream& random) {
    return {random.normal(), random.normal(), random.normal()};
  }
  ObservabilityReport report() { return observability_report(information_of(monitor), scene, fixed); }

  static constexpr int steps = 40;
  ObservabilityMonitor monitor{vehicle, 3};
  PlanarScene scene;
  FixedPoints fixed;
};

TEST(ObservabilityReport, ExactJacobiansAddNoInformationOnTheFrame) {
  const ObservabilityReport report = Drive(0).report();
  EXPECT_EQ(report.ideal_nullity, 3);
  EXPECT_EQ(report.information.nullity(), 3);
  EXPECT_EQ(report.information.errors, 11);
  EXPECT_FALSE(report.information.ambiguous);
  EXPECT_GT(report.information.gap(), 1e6);
  EXPECT_EQ(report.spurious_information, 0);
  for (const QuantityReport& q : report.quantities) {
    EXPECT_FALSE(q.ideally_observable || q.gained || q.estimated_sigma) << q.name;
  }
  EXPECT_EQ(in_words(report), (std::vector<std::string>{"position: unobservable", "heading: unobservable"}));
}

TEST(ObservabilityReport, VaryingJacobiansAddInformationOnTheHeadingOnly) {
  const ObservabilityReport report = Drive(0.02).report();
  EXPECT_EQ(report.ideal_nullity, 3);
  EXPECT_EQ(report.information.nullity(), 2);
  EXPECT_EQ(report.spurious_information, 1);
  EXPECT_FALSE(quantity(report, "x").estimated_sigma || quantity(report, "y").estimated_sigma);
  const QuantityReport heading = quantity(report, "heading");
  EXPECT_TRUE(heading.gained);
  EXPECT_FALSE(heading.ideally_observable);
  EXPECT_NE(in_words(report)[1].find(
                "heading: unobservable, but the filter has spurious information from measurements: sigma "),
            std::string::npos);
  EXPECT_LT(*quantity(Drive(0.04).report(), "heading").estimated_sigma, *heading.estimated_sigma);
}

TEST(ObservabilityReport, OneAnchorLeavesARotationAndTwoNothing) {
  const ObservabilityReport one = Drive(0, 1).report();
  EXPECT_EQ(one.ideal_nullity, 1);
  EXPECT_EQ(one.information.nullity(), 1);
  EXPECT_EQ(one.spurious_information, 0);
  EXPECT_EQ(in_words(one)[1], "heading: unobservable with 1 anchor");
  const ObservabilityReport two = Drive(0, 2).report();
  EXPECT_EQ(two.ideal_nullity, 0);
  EXPECT_EQ(two.information.nullity(), 0);
  for (const QuantityReport& q : two.quantities) EXPECT_TRUE(q.ideally_observable && q.gained) << q.name;
  EXPECT_EQ(in_words(two),
            (std::vector<std::string>{"position: fixed by 2 anchors", "heading: fixed by 2 anchors"}));
}

TEST(ObservabilityReport, UncoveredRunReportsNoFilterInformation) {
  Drive drive(0, 2);
  const ObservabilityReport report =
      observability_report(MonitoredInformation{}, drive.scene, drive.fixed, "the map moves");
  EXPECT_EQ(report.ideal_nullity, 0);
  EXPECT_EQ(report.information.errors, 0);
  EXPECT_FALSE(quantity(report, "heading").estimated_sigma);
  EXPECT_EQ(in_words(report), (std::vector<std::string>{
                                  "position: observable with 2 anchors", "heading: observable with 2 anchors",
                                  "the filter's information is not monitored: the map moves"}));
}

// Camera
// ---------------------------------------------------------------------------------------------------------

struct Journey {
  int known = 0;  ///< number of points with known position
  bool moves = true;
  int steps = 20;
  double unit = 1;              ///< scale of all lengths, except of the regularization of an initialization
  bool exact_positions = true;  ///< this regularization is declared as such
  double acceleration = 0;      ///< amplitude of the alternating commanded acceleration
  double sigma = 1;             ///< assumed accelerations, linear and angular
  // perturbation of the states at which Jacobians are evaluated, anew each time
  double off = 0;
  int points_from = 1000;  ///< step at which landmarks are converted to points
};

/// A camera that rotates and translates, or stands still, and measures points: some with known position, the
/// others initialized with inverse depth. All Jacobians at the true states, or at perturbed ones.
class Path {
 public:
  explicit Path(const Journey& journey) : j_(journey) {
    scene_.camera[3] = 1;
    if (j_.moves) scene_.camera.tail<6>() << 0.3, 0.1, 0.05, 0.02, -0.03, 0.05;
    scene_.camera.segment<3>(7) *= j_.unit;
    for (ObservabilityMonitor* monitor : both())
      if (j_.exact_positions) monitor->set_exact_position(3, 5e-5 * 2.4 * j_.unit);
    for (int i = 0; i < j_.known; ++i) measure(i, true);
    for (int i = j_.known; i < 8; ++i) augment(i);
    for (int step = 0; step < j_.steps; ++step) {
      move(step / 30.0);
      for (int i = 0; i < 8; ++i) measure(i, i < j_.known);
      if (step == j_.points_from) convert_to_points();
    }
    scene_.errors = monitor_.errors();
    for (auto& landmark : scene_.landmarks)
      landmark.first = monitor_.find(static_cast<BlockId>(landmark.id + 1))->first;
    fixed_.anchors = j_.known;
    fixed_.positions.resize(3, j_.known);
    for (int i = 0; i < j_.known; ++i) fixed_.positions.col(i) = point(i);
  }
  ObservabilityReport report() {
    return observability_report(information_of(monitor_), information_of(measurements_), scene_, fixed_);
  }

 private:
  std::array<ObservabilityMonitor*, 2> both() { return {&monitor_, &measurements_}; }
  Vector3d point(int i) const {
    return j_.unit * Vector3d(0.5 * (i % 3) - 0.5, 0.4 * (i / 3) - 0.3, 2 + 0.3 * (i % 4));
  }
  void move(double t) {
    Eigen::Matrix<double, 6, 1> u = Eigen::Matrix<double, 6, 1>::Zero(), variances;
    u.head<3>() << std::cos(2 * t), 0.7 * std::sin(2 * t + 1), 0.5 * std::cos(2 * t + 2);
    u *= j_.acceleration * j_.unit;
    const auto step = FreeCameraMotion{}.step(scene_.camera, u, 1.0 / 30);
    variances.setConstant(j_.sigma * j_.sigma);
    variances.head<3>() *= j_.unit * j_.unit;
    LinearizedMotion motion;
    motion.block = vehicle;
    motion.A = step.F;
    motion.N = step.G * variances.asDiagonal() * step.G.transpose();
    for (ObservabilityMonitor* monitor : both()) monitor->move(motion);
    scene_.camera = step.x;
  }
  void convert_to_points() {
    for (auto& landmark : scene_.landmarks) {
      const auto at = landmark_point(landmark);
      const BlockReplacement replacement{static_cast<BlockId>(landmark.id + 1), at->J,
                                         Eigen::Matrix3d::Zero()};
      for (ObservabilityMonitor* monitor : both()) monitor->replace(replacement);
      landmark.form = SpatialScene::Landmark::Form::point;
      landmark.mean.head<3>() = at->position;
    }
  }
  /// The perturbed camera state, at which a filter would linearize.
  CameraState perturbed_camera() {
    CameraState x = scene_.camera;
    for (int i = 0; i < 3; ++i) x[i] += j_.off * j_.unit * random_.normal();
    return x;
  }
  void augment(int i) {
    const auto pixel = PointLandmark::predict_measurement(camera_, scene_.camera, point(i))->pixel;
    const double depth = point(i).z();  // all landmarks are initialized at the start
    const auto initialized = InverseDepthLandmark::initialize(camera_, scene_.camera, pixel, 1 / depth);
    BlockAugmentation initialization;
    initialization.block = static_cast<BlockId>(i + 1);
    initialization.parents.push_back({vehicle, initialized->Jv});
    Eigen::Matrix<double, 6, 6> noise = 0.16 * initialized->Jz * initialized->Jz.transpose();
    noise.topLeftCorner<3, 3>() += 1e-8 * Eigen::Matrix3d::Identity();
    noise(5, 5) += 0.25;
    initialization.noise = noise;
    for (ObservabilityMonitor* monitor : both()) monitor->augment(initialization);
    SpatialScene::Landmark& landmark = scene_.landmarks.emplace_back();
    landmark.id = i;
    landmark.form = SpatialScene::Landmark::Form::inverse_depth;
    landmark.initial_axes.world_from_initial_camera = initialized->world_from_initial_camera;
    landmark.mean = initialized->landmark;
  }
  void measure(int i, bool known) {
    LinearizedMeasurement measurement;
    if (known) {
      measurement.add(vehicle, PointLandmark::predict_measurement(camera_, scene_.camera, point(i))->Hv);
    } else {
      for (const auto& landmark : scene_.landmarks)
        if (landmark.id == i) add_measurement(measurement, landmark);
    }
    measurement.residual = Vector2d::Zero();
    measurement.R = 0.16 * Eigen::Matrix2d::Identity();
    for (ObservabilityMonitor* monitor : both()) monitor->add_measurement(measurement);
  }
  void add_measurement(LinearizedMeasurement& measurement, const SpatialScene::Landmark& landmark) {
    const CameraState from = perturbed_camera();
    const auto block = static_cast<BlockId>(landmark.id + 1);
    const auto add = [&](const auto& seen) {
      measurement.add(vehicle, seen->Hv);
      measurement.add(block, seen->Hl);
    };
    if (landmark.form == SpatialScene::Landmark::Form::point)
      add(PointLandmark::predict_measurement(camera_, from, landmark.mean.head<3>()));
    else
      add(landmark.initial_axes.predict_measurement(camera_, from, landmark.mean));
  }

  Journey j_;
  RandomStream random_{1, "path"};
  Camera camera_ = WideAngleCamera{};
  ObservabilityMonitor monitor_{vehicle, 12};
  ObservabilityMonitor measurements_{vehicle, 12, ObservabilityMonitor::Motions::uninformative};
  SpatialScene scene_;
  FixedPoints fixed_;
};

TEST(ObservabilityReport, MovingCameraLacksWhatItsAnchorsDoNotFix) {
  const int ideal[] = {7, 4, 1, 1, 0};  // the first three points are collinear
  for (int known = 0; known <= 4; ++known) {
    const ObservabilityReport report = Path({.known = known}).report();
    EXPECT_EQ(report.ideal_nullity, ideal[known]) << known;
    EXPECT_EQ(report.information.nullity(), ideal[known]) << known;
    EXPECT_FALSE(report.information.ambiguous) << known;
    EXPECT_EQ(report.spurious_information, 0) << known;
    EXPECT_TRUE(report.without_information.empty()) << report.without_information.front();
    const QuantityReport scale = quantity(report, "scale");
    EXPECT_EQ(scale.ideally_observable, known >= 2) << known;
    EXPECT_EQ(scale.gained, known >= 2) << known;
  }
}

TEST(ObservabilityReport, ReportsTheScale) {
  EXPECT_EQ(in_words(Path({.known = 4}).report())[2], "scale: fixed by 4 anchors");
  EXPECT_EQ(in_words(Path({.known = 0}).report())[2], "scale: unobservable");
  EXPECT_EQ(in_words(Path({.known = 1}).report())[2], "scale: unobservable with 1 anchor");
}

// v' = v + a dt with known a does not scale or rotate with v: all Jacobians are true, but the motion does not
// preserve the symmetries. This information is not spurious
TEST(ObservabilityReport, InformationFromTheMotionModelIsNotSpurious) {
  const ObservabilityReport report = Path({.steps = 200, .acceleration = 1, .sigma = 0.02}).report();
  EXPECT_EQ(report.ideal_nullity, 7);
  EXPECT_EQ(report.information.nullity(), 3);
  EXPECT_EQ(report.spurious_information, 0);
  EXPECT_EQ(report.by_motion_model, 4);
  const QuantityReport scale = quantity(report, "scale");
  EXPECT_TRUE(scale.gained && scale.by_motion_model);
  EXPECT_LT(*scale.estimated_sigma, 0.1);
  EXPECT_FALSE(scale.sigma_from_measurements);
  EXPECT_FALSE(quantity(report, "x").by_motion_model);
  const std::vector<std::string> words = in_words(report);
  EXPECT_EQ(words[0], "position: unobservable");
  EXPECT_EQ(words[1].find("orientation: unobservable by measurements; information on rotation about "), 0u)
      << words[1];
  EXPECT_NE(words[1].find(" from the motion model: sigma "), std::string::npos) << words[1];
  EXPECT_EQ(words[2].find("scale: unobservable by measurements; information from the motion model: sigma "),
            0u)
      << words[2];
}

// However small the assumed accelerations: without commands the motion preserves the symmetries
TEST(ObservabilityReport, SmallAccelerationsAloneAreNoReference) {
  const ObservabilityReport report = Path({.steps = 200, .sigma = 0.001}).report();
  EXPECT_EQ(report.information.nullity(), 7);
  EXPECT_EQ(report.spurious_information, 0);
  EXPECT_EQ(report.by_motion_model, 0);
}

TEST(ObservabilityReport, InformationOnTheScaleFromMeasurementsIsSpurious) {
  for (const double acceleration : {0.0, 1.0}) {
    const ObservabilityReport report =
        Path({.steps = 200, .acceleration = acceleration, .sigma = 0.02, .off = 0.05}).report();
    EXPECT_GE(report.spurious_information, 1) << acceleration;
    EXPECT_LE(report.spurious_information + report.by_motion_model, 7);
    const QuantityReport scale = quantity(report, "scale");
    EXPECT_TRUE(scale.gained && scale.sigma_from_measurements && !scale.by_motion_model) << acceleration;
    EXPECT_LE(*scale.estimated_sigma, *scale.sigma_from_measurements * (1 + 1e-9));
    EXPECT_NE(in_words(report)[2].find("but the filter has spurious information from measurements: sigma "),
              std::string::npos);
  }
}

// The regularization of an initial position is in meters
TEST(ObservabilityReport, IsIndependentOfTheUnitOfLength) {
  for (const double acceleration : {0.0, 1.0}) {
    Journey journey{.steps = 100, .acceleration = acceleration, .sigma = 0.1};
    const ObservabilityReport in_meters = Path(journey).report();
    EXPECT_FALSE(in_meters.information.ambiguous);
    for (const double unit : {1e-3, 1e3}) {
      journey.unit = unit;
      const ObservabilityReport report = Path(journey).report();
      EXPECT_EQ(report.information.rank, in_meters.information.rank) << unit;
      EXPECT_FALSE(report.information.ambiguous) << unit;
      EXPECT_EQ(report.by_motion_model, in_meters.by_motion_model) << unit;
    }
  }
}

// At its own scale, a regularization among kilometers would leave only rounding of the rest
TEST(ObservabilityReport, RankIsTheSameInAnyUnitOrReportedAsAmbiguous) {
  for (const int points_from : {1000, 50})
    for (const bool exact_positions : {true, false}) {
      if (!exact_positions && points_from == 50) continue;  // rounding of conversions is not tracked so far
      Journey journey{.steps = 100, .exact_positions = exact_positions, .acceleration = 1, .sigma = 0.1};
      const int nullity = Path(journey).report().information.nullity();
      journey.points_from = points_from;
      for (const double unit : {1e-3, 1e2, 1e3, 1e4}) {
        journey.unit = unit;
        const ObservabilityReport report = Path(journey).report();
        EXPECT_TRUE(report.information.ambiguous || report.information.nullity() == nullity)
            << unit << " " << points_from << " " << exact_positions << ", " << report.information.nullity()
            << ", tolerance " << report.information.tolerance;
        EXPECT_EQ(report.spurious_information, 0) << unit << " " << points_from << " " << exact_positions;
      }
    }
}

// Ranks
// ---------------------------------------------------------------------------------------------------------

TEST(ObservabilityReport, RankNearRoundingIsReportedAsAmbiguous) {
  Eigen::VectorXd values(4);
  values << 1e6, 1e3, 1, 0;
  const Eigen::VectorXd units = Eigen::VectorXd::Ones(4);
  const auto rank = [&](const Eigen::VectorXd& gathered) {
    return rank_of_information({values.asDiagonal(), gathered}, units);
  };
  const InformationRank clear = rank(values);
  EXPECT_EQ(clear.rank, 3);
  EXPECT_EQ(clear.nullity(), 1);
  EXPECT_FALSE(clear.ambiguous);
  values[2] = 3 * clear.tolerance;
  EXPECT_TRUE(rank(values).ambiguous);
  values[2] = 1e15;  // rounding now hides as much as is worth resolving
  EXPECT_TRUE(rank(values).ambiguous);
  values[2] = 1;
  // most of this information is forgotten later, its rounding is not
  EXPECT_TRUE(rank(1e9 * values).ambiguous);
}

}  // namespace
}  // namespace incognita
