// Example 3.4: the planar vehicle with range and bearing, and how many anchors it takes to observe it.
//
// Experiment: the models of planar_vehicle.hpp and range_bearing.hpp at 100 random poses, inputs and
// landmarks (positions within 5 m, at least 1 m away; speed 0.5 to 2 m/s, turn rate 0.2 to 1 rad/s; dt 0.5 s;
// sensor 0.3 m before the axle). No chance beyond that, no noise. Measured: printed Jacobians against central
// differences of the printed models; ranks of (3.24), with F and H frozen, and of [H_0; H_1 F_0; H_2 F_1 F_0;
// ...] along the motion, over 8 measurements. Holds: Jacobians to 1e-6; ranks by singular values above 1e-9
// of the largest, with at least a factor of 1000 between what counts and what does not, the same at all 100.
#include <optional>

#include "experiments/common.hpp"
#include "incognita/analysis/observability/linear_system.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/models/sensors/range_bearing.hpp"

namespace incognita {
namespace {

constexpr int places = 100, measurements = 8;
constexpr double dt = 0.5;  // s

/// A pose, an input and points to measure, anchors or landmarks.
struct Placement {
  Vector3d pose;
  Vector2d input;
  Vector2d landmark;
  std::vector<Vector2d> anchors;  ///< the first at the origin
};

Vector2d point(RandomStream& random, const Vector3d& pose) {
  for (;;) {
    const Vector2d p(random.uniform(-5, 5), random.uniform(-5, 5));
    if ((p - pose.head<2>()).norm() > 1) return p;
  }
}

std::vector<Placement> random_positions() {
  RandomStream random(1, "places");
  std::vector<Placement> all(places);
  for (Placement& p : all) {
    p.pose << point(random, Vector3d::Zero()), random.uniform(-pi, pi);
    p.input << random.uniform(0.5, 2), random.uniform(0.2, 1);
    p.landmark = point(random, p.pose);
    p.anchors = {Vector2d::Zero(), point(random, p.pose)};
  }
  return all;
}

const DifferentialDrive vehicle{0.3, 0};

/// Central differences of a function of one vector.
template <class Function>
MatrixXd differences(const Function& f, const VectorXd& x) {
  constexpr double h = 1e-6;
  MatrixXd J(f(x).size(), x.size());
  for (Index i = 0; i < x.size(); ++i) {
    const VectorXd d = h * VectorXd::Unit(x.size(), i);
    J.col(i) = (f(x + d) - f(x - d)) / (2 * h);
  }
  return J;
}

/// Largest differences of a printed Jacobian and ours from numerical derivatives.
std::string from_numerical(const Worst& worst) {
  return fmt::format("largest difference from numerical derivatives at {} poses: {}", places, worst.text());
}

constexpr double as_good_as_zero = 1e-6;

std::vector<Claim> motion_jacobians() {
  Worst by_state, by_input;
  for (const Placement& p : random_positions()) {
    const double c = std::cos(p.pose[2]), s = std::sin(p.pose[2]), v = p.input[0], lw = 0.3 * p.input[1];
    Matrix3d F = Matrix3d::Identity();
    F.col(2).head<2>() << -(v * s - lw * c) * dt, (v * c - lw * s) * dt;
    Eigen::Matrix<double, 3, 2> G;
    G << c * dt, -0.3 * s * dt, s * dt, 0.3 * c * dt, 0, 1;
    const auto f = [](const VectorXd& x) -> VectorXd {
      return vehicle.f<double>(Vector3d(x.head<3>()), Vector2d(x.tail<2>()), dt);
    };
    VectorXd at(5);
    at << p.pose, p.input;
    const MatrixXd numerical = differences(f, at);
    const auto ours = vehicle.step(p.pose, p.input, dt);
    by_state.take(F, ours.F, numerical.leftCols<3>());
    by_input.take(G, ours.G, numerical.rightCols<2>());
  }
  return {assessed("3.4-F", "(3.17)", "Jacobian of (3.16) by the state, to 1e-6",
                   {.printed = "-(v sin theta - l w cos theta) dt in the first row",
                    .measured = from_numerical(by_state),
                    .number = exactly("largest difference of the printed entry", by_state.printed),
                    .why = "-(v sin theta + l w cos theta) dt",
                    .runs = places},
                   by_state.printed <= as_good_as_zero, as_corrected(by_state.ours <= as_good_as_zero)),
          assessed("3.4-G", "(3.18)", "Jacobian of (3.16) by the input noises, to 1e-6",
                   {.printed = "last row [0 1]",
                    .measured = from_numerical(by_input),
                    .number = exactly("largest difference of the printed entry", by_input.printed, "s"),
                    .why = "last row [0 dt]",
                    .runs = places},
                   by_input.printed <= as_good_as_zero, as_corrected(by_input.ours <= as_good_as_zero))};
}

/// Where the direction to a landmark is known to be: turning by it and driving ahead must lead to the
/// landmark.
Claim bearing() {
  Worst worst;
  double without_quarter = 0;
  int behind = 0;
  for (const Placement& p : random_positions()) {
    const Vector2d d = p.landmark - p.pose.head<2>();
    const double as_printed = std::atan(d.y() / d.x()) - p.pose[2] + pi / 2;
    const Vector2d z = RangeBearing::predict_measurement(p.pose, p.landmark)->z;
    const auto miss = [&](double b) {
      return (RangeBearing::initialize(p.pose, {z[0], b}).landmark - p.landmark).norm();
    };
    worst.take(miss(as_printed), miss(z[1]));
    without_quarter = std::max(without_quarter, miss(as_printed - pi / 2));
    behind += miss(as_printed - pi / 2) > 1 ? 1 : 0;
  }
  return assessed(
      "3.4-bearing", "(3.19)",
      "The bearing of a landmark, from the heading: following it leads to the landmark, to 1e-6 m",
      {.printed = "atan(dy/dx) - theta + pi/2",
       .measured = {"largest miss at {} poses: printed {:.2g} m; without the pi/2 still {:.2g} m, wrong at "
                    "{} poses; ours {}",
                    places, worst.printed, without_quarter, behind, below(worst.ours)},
       .number = exactly("largest miss by the printed bearing", worst.printed, "m"),
       .why =
           "atan2(dy, dx) - theta: atan does not distinguish opposite directions, and the pi/2 belongs to a "
           "laser that counts from its right",
       .runs = places},
      worst.printed <= as_good_as_zero, as_corrected(worst.ours <= as_good_as_zero));
}

Claim anchor_bearing() {
  Worst worst;
  for (const Placement& p : random_positions()) {
    const double truth = RangeBearing::predict_measurement(p.pose, Vector2d::Zero())->z[1];
    const double x = p.pose.x(), y = p.pose.y();
    worst.take(std::abs(wrap_angle<double>(std::atan(y / x) - p.pose[2] + pi / 2 - truth)),
               std::abs(wrap_angle<double>(std::atan2(-y, -x) - p.pose[2] - truth)));
  }
  return assessed("3.4-anchor-bearing", "(3.21)",
                  "The bearing of an anchor at the origin is (3.19) with the landmark there, to 1e-6 rad",
                  {.printed = "atan(y/x) - theta + pi/2",
                   .measured = {"largest difference at {} poses: printed {:.3g} rad, ours {}", places,
                                worst.printed, below(worst.ours)},
                   .number = exactly("largest difference of the printed bearing", worst.printed, "rad"),
                   .why = "atan2(-y, -x) - theta",
                   .runs = places},
                  worst.printed <= as_good_as_zero, as_corrected(worst.ours <= as_good_as_zero));
}

/// Jacobian of one measurement of an anchor or of the landmark, by the pose and the landmark.
MatrixXd measurement_rows(const Vector3d& pose, const Vector2d& at, bool anchor) {
  const auto prediction = RangeBearing::predict_measurement(pose, at);
  MatrixXd H = MatrixXd::Zero(2, 5);
  H.leftCols<3>() = prediction->Hv;
  if (!anchor) H.rightCols<2>() = prediction->Hl;
  return H;
}

/// (3.20) and (3.22), differentiated together by pose and landmark.
Claim measurement_jacobians() {
  Worst worst;
  for (const Placement& p : random_positions()) {
    const double x = p.pose.x(), y = p.pose.y(), r2 = x * x + y * y, r = std::sqrt(r2);
    const Vector2d to = p.landmark - p.pose.head<2>();
    const double d = to.norm(), d2 = d * d;
    MatrixXd printed(4, 5), ours(4, 5);
    printed << x / r, y / r, 0, 0, 0, -y / r2, x / r2, -1, 0, 0,  //
        -to.x() / d, -to.y() / d, 0, to.x() / d, to.y() / d,      //
        to.y() / d2, -to.x() / d2, -1, -to.y() / d2, to.x() / d2;
    ours << measurement_rows(p.pose, Vector2d::Zero(), true), measurement_rows(p.pose, p.landmark, false);
    VectorXd state(5);
    state << p.pose, p.landmark;
    const auto h = [](const VectorXd& s) -> VectorXd {
      Eigen::Vector4d z;
      z << RangeBearing::h<double>(Vector3d(s.head<3>()), Vector2d::Zero()),
          RangeBearing::h<double>(Vector3d(s.head<3>()), Vector2d(s.tail<2>()));
      return z;
    };
    worst.take(printed, ours, differences(h, state));
  }
  return assessed("3.4-H", "(3.20), (3.22)",
                  "Jacobians of range and bearing, of a landmark and of the anchor, to 1e-6",
                  {.measured = from_numerical(worst), .runs = places}, worst.printed <= as_good_as_zero);
}

// Observability ---------------------------------------------------------------------------------------

struct View {
  int anchors = 0;
  bool oriented = false;  ///< the first anchor's orientation is measured too
};

/// Jacobian of all measurements from a pose; states: pose, landmark.
MatrixXd rows_seen(const Placement& p, const Vector3d& pose, const View& view) {
  MatrixXd H(2 * (view.anchors + 1) + (view.oriented ? 1 : 0), 5);
  for (int a = 0; a < view.anchors; ++a) H.middleRows(2 * a, 2) = measurement_rows(pose, p.anchors[a], true);
  H.middleRows(2 * view.anchors, 2) = measurement_rows(pose, p.landmark, false);
  if (view.oriented) H.bottomRows(1) << 0, 0, -1, 0, 0;
  return H;
}

MatrixXd transition(const DifferentialDrive& drive, const Vector3d& pose, const Vector2d& input) {
  MatrixXd F = MatrixXd::Identity(5, 5);
  F.topLeftCorner<3, 3>() = drive.step(pose, input, dt).F;
  return F;
}

/// [H_0; H_1 F_0; H_2 F_1 F_0; ...], each where the vehicle then is; or (3.24), all at the first pose.
MatrixXd observability(const Placement& p, const View& view, const DifferentialDrive& drive, bool frozen) {
  Vector3d pose = p.pose;
  MatrixXd since_start = MatrixXd::Identity(5, 5);
  const Index rows = rows_seen(p, pose, view).rows(), count = frozen ? 5 : measurements;
  MatrixXd O(count * rows, 5);
  for (Index k = 0; k < count; ++k) {
    O.middleRows(k * rows, rows) = rows_seen(p, pose, view) * since_start;
    since_start = transition(drive, pose, p.input) * since_start;
    if (!frozen) pose = drive.step(pose, p.input, dt).x;
  }
  return O;
}

/// The rank of a matrix at all poses; none when it is not the same or not clear.
struct Ranks {
  std::optional<int> rank;
  double least_kept = 1, most_left_out = 0;  ///< singular values, of the largest
  bool is(int expected) const { return rank == expected; }
  std::string text() const {
    if (!rank) return "not clear";
    const std::string kept = fmt::format("singular values of the largest: kept from {:.1e} on", least_kept);
    if (*rank == 5) return fmt::format("5 of 5 ({})", kept);
    return fmt::format("{} of 5 ({}, left out {})", *rank, kept, below(most_left_out));
  }
};

Ranks ranks(const View& view, const DifferentialDrive& drive, bool frozen) {
  Ranks all;
  bool clear = true;
  for (const Placement& p : random_positions()) {
    const Rank r = rank_of(observability(p, view, drive, frozen), 1e-9);
    const VectorXd relative = r.singular_values / r.singular_values[0];
    all.least_kept = std::min(all.least_kept, relative[r.rank - 1]);
    if (r.rank < relative.size()) all.most_left_out = std::max(all.most_left_out, relative[r.rank]);
    clear = clear && r.gap >= 1000 && all.rank.value_or(r.rank) == r.rank;
    all.rank = r.rank;
  }
  if (!clear) all.rank.reset();
  return all;
}

Ranks frozen_rank(const View& view, const DifferentialDrive& drive = vehicle) {
  return ranks(view, drive, true);
}
Ranks true_rank(const View& view) { return ranks(view, vehicle, false); }

/// (3.25), rows five to eight: what H F has in the heading's column beyond H.
Claim printed_product() {
  Worst worst;
  const DifferentialDrive at_axle;
  for (const Placement& p : random_positions()) {
    const double c = std::cos(p.pose[2]), s = std::sin(p.pose[2]), v = p.input[0], x = p.pose.x(),
                 y = p.pose.y();
    const Vector2d to = p.landmark - p.pose.head<2>();
    const double d = to.norm(), r2 = x * x + y * y, r = std::sqrt(r2);
    const Eigen::Vector4d as_printed(-(to.x() * v * s + to.y() * v * c) / d,
                                     -(to.x() * v * c - to.y() * v * s) / (d * d),
                                     (x * v * s + y * v * c) / r2, (x * v * c + y * v * s) / r2);
    const Eigen::Vector4d corrected((to.x() * v * s - to.y() * v * c) / d,
                                    -(to.x() * v * c + to.y() * v * s) / (d * d),
                                    -(x * v * s - y * v * c) / r, (x * v * c + y * v * s) / r2);
    MatrixXd H(4, 5);
    H << measurement_rows(p.pose, p.landmark, false), measurement_rows(p.pose, Vector2d::Zero(), true);
    const Eigen::Vector4d truth = (H * transition(at_axle, p.pose, p.input) - H).col(2) / dt;
    worst.take(as_printed, corrected, truth);
  }
  return assessed("3.4-product", "(3.25), rows 5 to 8",
                  "Heading's column of (H F - H)/dt with l = 0, to 1e-6",
                  {.printed = "rows -(dx v sin + dy v cos)/d, -(dx v cos - dy v sin)/d^2, (x v sin + y v "
                              "cos)/r^2, (x v cos + y v sin)/r^2",
                   .measured = {"largest difference at {} poses: {}", places, worst.text()},
                   .number = exactly("largest difference of the printed entries", worst.printed),
                   .why = "(dx v sin - dy v cos)/d, -(dx v cos + dy v sin)/d^2, -(x v sin - y v cos)/r, and "
                          "the last as printed",
                   .runs = places},
                  worst.printed <= as_good_as_zero, as_corrected(worst.ours <= as_good_as_zero));
}

Claim frozen_product_rank() {
  const Ranks offset = frozen_rank({.anchors = 1}), at_axle = frozen_rank({.anchors = 1}, {});
  return assessed("3.4-frozen-rank", "(3.24), (3.25)",
                  "The product (3.24) has full rank with one anchor, also with l other than 0",
                  {.rule = Rule::dimension,
                   .measured = {"l = 0.3 m: {}; l = 0: {}", offset.text(), at_axle.text()},
                   .runs = places},
                  offset.is(5) && at_axle.is(5));
}

/// Turning pose and landmark about the first anchor, at the origin.
VectorXd turn_about_the_anchor(const Placement& p) {
  VectorXd turn(5);
  turn << -p.pose.y(), p.pose.x(), 1, -p.landmark.y(), p.landmark.x();
  return turn.normalized();
}

Claim one_anchor_observes_all() {
  const Ranks one = true_rank({.anchors = 1}), frozen = frozen_rank({.anchors = 1});
  double seen = 0;
  for (const Placement& p : random_positions())
    seen =
        std::max(seen, (observability(p, {.anchors = 1}, vehicle, false) * turn_about_the_anchor(p)).norm());
  return by_the_method(
      assessed(
          "3.4-one-anchor", "below (3.25)",
          "One anchor and any other landmark guarantee that the planar vehicle is fully observable: rank 5 along "
          "its motion",
          {.rule = Rule::dimension,
           .measured =
               {"along the motion, over {} measurements: {}. What a turn about the anchor changes in them: "
                "{}. The product (3.24): {}",
                measurements, one.text(), below(seen), frozen.text()},
           .number = exactly("rank of 5 along the motion", one.rank.value_or(0)),
           .why =
               "turning everything about the anchor changes no measurement. (3.24) has full rank because H is "
               "frozen in it while F moves the vehicle",
           .runs = places},
          one.is(5), in_truth(one.is(4) && seen < 1e-9 && frozen.is(5))),
      frozen.is(5));
}

Claim what_it_takes() {
  const Ranks two = true_rank({.anchors = 2}), oriented = true_rank({.anchors = 1, .oriented = true});
  return assessed(
      "3.4-two-anchors", "below (3.25)", "One anchor with orientation, or two without, are enough",
      {.rule = Rule::dimension,
       .measured = {"along the motion: two anchors {}; one with orientation {}", two.text(), oriented.text()},
       .runs = places},
      two.is(5) && oriented.is(5));
}

Claim no_anchor() {
  const Ranks product = frozen_rank({}), truth = true_rank({});
  return assessed(
      "3.4-no-anchor", "Section 3.1, above Example 3.2",
      "Without anchors the planar vehicle that measures range and bearing is partially observable",
      {.rule = Rule::dimension,
       .measured = {"along the motion {}; the product (3.24), in which H is frozen, {}", truth.text(),
                    product.text()},
       .number = exactly("rank of 5 along the motion", truth.rank.value_or(0)),
       .runs = places},
      truth.rank && *truth.rank < 5);
}

// Figure 3.9 ------------------------------------------------------------------------------------------

Curve outline(const std::string& label, const Vector3d& pose, const std::vector<Vector2d>& corners,
              Style style, Color color) {
  return path_of(label, style, color, corners, [&](const Vector2d& corner) -> Vector2d {
    return pose.head<2>() + Eigen::Rotation2Dd(pose[2]) * corner;
  });
}

/// The vehicle at 30 degrees, its axle's middle at the origin of the body; m.
Plot geometry() {
  const Vector3d pose(1, 0.6, pi / 6);
  const double l = vehicle.forward_m;
  const auto rectangle = [&](const char* label, double x0, double y0, double x1, double y1, Color color) {
    return outline(label, pose, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}}, Style::line, color);
  };
  Panel p{"", "x, m", "y, m", {}, true};
  p.curves = {rectangle("body", -0.2, -0.22, 0.42, 0.22, Color::ink),
              outline("axle and wheels", pose, {{0, -0.25}, {0, 0.25}}, Style::line, Color::gray),
              rectangle("", -0.1, -0.28 - 0.03, 0.1, -0.28 + 0.03, Color::gray),
              rectangle("", -0.1, 0.28 - 0.03, 0.1, 0.28 + 0.03, Color::gray),
              outline("l, from the axle to the sensor", pose, {{0, 0}, {l, 0}}, Style::line, Color::orange),
              outline("sensor (x_r, y_r)", pose, {{l, 0}}, Style::circles, Color::orange),
              outline("heading theta", pose, {{l, 0}, {0.75, 0}, {0.69, 0.03}, {0.69, -0.03}, {0.75, 0}},
                      Style::line, Color::blue),
              outline("world x", {pose.x(), pose.y(), 0}, {{0, 0}, {0.75, 0}}, Style::dashed, Color::gray)};
  return {"fig-3.9", "Vehicle with differential steering", 1, {p}};
}

LedgerEntry run_example_3_4(const ExperimentSettings& settings) {
  return entry_of(
      example_3_4, settings,
      {motion_jacobians(), bearing(), anchor_bearing(), measurement_jacobians(), printed_product(),
       frozen_product_rank(), one_anchor_observes_all(), what_it_takes(), no_anchor()},
      {geometry()});
}

}  // namespace

const Experiment example_3_4{"3.4", "A planar vehicle with range and bearing", {"fig-3.9"}, run_example_3_4};

}  // namespace incognita
