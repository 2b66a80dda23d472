// (5.7) to (5.15) as printed, and as they have to be read.
//
// Experiment: the vehicle of closed_loop_run.hpp with its state known and no noise, along exact arcs; 1000
// random poses and inputs of up to 1 m/s and 1 rad/s; laws from (-7, 0), heading 0, for 144 s, two rounds of
// the circle, of which the second counts. Holds: identities to 1e-9; a law follows the circle when its error
// stays below 5 cm.
#include "experiments/common.hpp"
#include "experiments/example_5_2.hpp"
#include "incognita/control/feedback_linearization.hpp"

namespace incognita::section_5_2 {
namespace {

using namespace closed_loop;

constexpr int samples = 1000;
constexpr double as_good_as_zero = 1e-9;

struct Sample {
  Pose pose;
  Vector2d input;
};

std::vector<Sample> some_samples() {
  RandomStream random(1, "places");
  std::vector<Sample> all;
  for (int i = 0; i < samples; ++i) {
    Sample p;
    p.pose << random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(-3.1, 3.1);
    p.input << random.uniform(-1, 1), random.uniform(-1, 1);
    all.push_back(p);
  }
  return all;
}

Claim model() {
  Worst worst;
  double held = 0;
  for (const Sample& p : some_samples()) {
    const Vector2d y = p.pose.head<2>(), velocity = point_velocity_by_input(body, p.pose[2]) * p.input;
    const Vector2d next = moved(p.pose, p.input).head<2>();
    worst.take((velocity - next).norm(), (velocity - body.rate<double>(p.pose, p.input).head<2>()).norm());
    held = std::max(held, (y + period_s * velocity - next).norm());
  }
  return assessed(
      "5.2-model", "(5.7), (5.20)", "How the control point moves, to 1e-9",
      {.printed = "y_(k+1) = Q_r u_k",
       .measured = {"largest difference at {} poses and inputs: printed {:.3g} m; its velocity from Q_r u, "
                    "in m/s, {}; y_k + dt Q_r u_k with the input held for {} s {:.2g} m",
                    samples, worst.printed, below(worst.ours), period_s, held},
       .number = exactly("largest difference of the printed form", worst.printed, "m"),
       .why = "it is the velocity of the point that is Q_r u, so that y_(k+1) is y_k + dt Q_r u_k but for "
              "what the body turns meanwhile",
       .runs = samples},
      worst, as_good_as_zero);
}

Claim linearized() {
  double worst = 0, turned = 0;
  for (const Sample& p : some_samples()) {
    const Vector2d wanted = p.input;  // any velocity
    const Vector2d u = input_for_velocity(body, p.pose[2], wanted);
    worst = std::max(worst, (body.rate<double>(p.pose, u).head<2>() - wanted).norm());
    const Vector2d by_command = moved(p.pose, limited(u, body_limits).input()).head<2>() - p.pose.head<2>();
    const double angle = std::acos(std::min(1.0, by_command.normalized().dot(wanted.normalized())));
    turned = std::max(turned, degrees(angle));
  }
  return assessed("5.2-linearised", "(5.8), Section 5.2",
                  "With u = Q_r^-1 U the nonlinearity is cancelled exactly, not approximately: the control "
                  "point moves with the velocity U at every heading, to 1e-9 m/s",
                  {.measured = {"largest difference at {} poses and velocities, in m/s: {}. Held for {} s at "
                                "up to 1 rad/s the motion is turned by up to {:.1f} deg",
                                samples, below(worst), period_s, turned},
                   .runs = samples},
                  worst <= as_good_as_zero);
}

Claim pseudo_inverse() {
  const Matrix2d on_axle = point_velocity_by_input({0, 0}, 0.7),
                 off_axle = point_velocity_by_input(body, 0.7);
  const double printed = (on_axle.transpose() * on_axle).determinant();
  const Law smallest = [](const Pose& pose, double t) -> Vector2d {
    return point_velocity_by_input({0, 0}, pose[2])
        .completeOrthogonalDecomposition()
        .solve(velocity_towards(at(Path(circle), t), gain_per_s * Matrix2d::Identity(), pose.head<2>()));
  };
  const Way way = steer(smallest, {-7, 0, 0}, two_rounds_s, {0, 0});
  const double mean = mean_of(way.distances_m(circle, second_round)).value;
  double turned = 0;
  for (const Vector2d& input : way.inputs) turned += period_s * std::abs(input[1]);
  const bool usable = printed > as_good_as_zero;
  return assessed("5.2-pseudo-inverse", "footnote 1, Section 5.2",
                  "Where Q_r has not full rank (l = 0) the pseudo-inverse can be used in (5.8): it exists, "
                  "and the vehicle follows the circle within 5 cm in the second round",
                  {.rule = Rule::example,
                   .printed = "(Q_r' Q_r)^-1 Q_r'",
                   .measured = {"l = 0: det(Q_r' Q_r) = {:.1e}; with Moore and Penrose's, which exists, the "
                                "vehicle is {:.1f} m off its path on average of the second round and turned "
                                "by {:.1e} rad in all. l = {} m: det(Q_r) = {:.3f} m",
                                printed, mean, turned, body.forward_m, off_axle.determinant()},
                   .number = exactly("distance from the path with the pseudo-inverse", mean, "m"),
                   .why = "Q_r' Q_r is singular exactly where the formula is meant for, and the true "
                          "pseudo-inverse never turns the vehicle. Off the axle no pseudo-inverse is needed"},
                  usable && mean < 0.05,
                  in_truth(!usable && turned < as_good_as_zero && off_axle.determinant() > as_good_as_zero));
}

Vector2d wanted_velocity(double t, bool with_rate) {
  const Vector2d velocity = at(Path(circle), t).velocity.head<2>();
  return with_rate ? velocity : Vector2d(velocity / circle.rate_rad_s);  // (5.15)
}

/// u = sign Q_r^-1 (ydot* + feedback (y* - y))
Law reading(double sign, double feedback, bool with_rate) {
  return [=](const Pose& pose, double t) -> Vector2d {
    const Vector2d ahead = at(Path(circle), t).position.head<2>() - pose.head<2>();
    return sign * input_for_velocity(body, pose[2], wanted_velocity(t, with_rate) + feedback * ahead);
  };
}

/// From the circle in the second round.
std::vector<double> errors_m(const Law& law) {
  return steer(law, {-7, 0, 0}, two_rounds_s).distances_m(circle, second_round);
}

Claim law() {
  const double K = gain_per_s;
  const std::vector<double> printed = errors_m(reading(-1, -K, false)), ours = errors_m(reading(1, K, true));
  const auto mean = [](const std::vector<double>& errors) { return mean_of(errors).value; };
  const std::string measured = fmt::format(
      "mean error in the second round: (5.12) with (5.15) {:.3g} m; (5.12) with w in (5.15) {:.3g} m; (5.21) "
      "with w {:.3g} m; (5.9) with (5.15) {:.3g} m; ours {:.3g} m; ours at most {:.1e} m",
      mean(printed), mean(errors_m(reading(-1, -K, true))), mean(errors_m(reading(1, -K, true))),
      mean(errors_m(reading(1, K, false))), mean(ours), std::ranges::max(ours));
  return assessed(
      "5.2-law", "(5.8), (5.9), (5.12), (5.15)",
      "The control law follows the circle, within 5 cm in the second round",
      {.printed = "u = -Q_r^-1 (y*_(k+1) - Q2 (y* - y)), (5.12); U = y*_(k+1) - Q2 (y - y*), (5.9)",
       .measured = measured,
       .number = exactly("mean error of the second round by (5.12)", mean(printed), "m"),
       .why = "u = Q_r^-1 (ydot* + Q2 (y* - y)), with the velocity of the path and its factor w. (5.9) has "
              "these signs, (5.12) drives with the negative velocity, (5.21) away from the path"},
      Worst{std::ranges::max(printed), std::ranges::max(ours)}, 0.05);
}

Claim velocity_of_path() {
  Worst worst;
  for (int k = 1; k < 72; ++k) {  // before its start the path stands
    constexpr double h = 1e-4;
    const Vector2d truth =
        (at(Path(circle), k + h).position - at(Path(circle), k - h).position).head<2>() / (2 * h);
    worst.take((wanted_velocity(k, false) - truth).norm(), (wanted_velocity(k, true) - truth).norm());
  }
  return assessed(
      "5.2-velocity", "(5.15)", "(5.15) is the velocity of (5.14), to 1e-6 m/s",
      {.printed = "r [-sin(w k), cos(w k)]",
       .measured =
           {"largest difference from differences of (5.14): printed {:.2f} m/s, ours {}; r w is {:.3f} m/s",
            worst.printed, below(worst.ours), circle.radius_m * circle.rate_rad_s},
       .number = exactly("largest difference of the printed form", worst.printed, "m/s"),
       .why = "it lacks the factor w"},
      worst, 1e-6);
}

}  // namespace

Matrix2d gain(const Pose& pose) { return gain_per_s * point_velocity_by_input(body, pose[2]).inverse(); }

Robot robot(const Pose& start, const Path& path) {
  Robot robot = closed_loop::robot(start, ControlLaw::feedback_linearization, path);
  robot.steering.gain_per_s = {gain_per_s};
  return robot;
}

Way follow(const Path& path, const Pose& start, double duration_s) {
  const FeedbackLinearization law({.body = body,
                                   .gain_per_s = gain_per_s * Matrix2d::Identity(),
                                   .hold_s = period_s,
                                   .limits = body_limits});
  return steer([&](const Pose& pose, double t) { return law.act(pose, at(path, t)).input(); }, start,
               duration_s);
}

std::vector<Claim> equation_claims() {
  return {model(), linearized(), pseudo_inverse(), law(), velocity_of_path()};
}

}  // namespace incognita::section_5_2
