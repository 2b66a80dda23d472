// (6.7) and (6.8): what the Fisher information is, and what it leads to.
//
// Experiment: the camera of section_6_1.hpp. A new landmark is known to 2 cm across the ray and to 0.8 m along it,
// as after its first measurement (0.5 to 5 m away); a well-known one to 1 cm. Actions move the camera by 0.5 m
// in one of 120 directions. Landmarks are drawn 1 to 2.5 m away, within 60 degrees of the camera's heading.
#include <array>

#include "experiments/common.hpp"
#include "experiments/monobot.hpp"
#include "experiments/section_6_1.hpp"
#include "incognita/analysis/observability/linear_system.hpp"
#include "incognita/models/sensors/bearing.hpp"

namespace incognita::section_6_1_plane {
namespace {

constexpr int layouts = 100;

Vector2d drawn_point(RandomStream& random) {
  const double angle = random.uniform(-pi / 3, pi / 3), away = random.uniform(1, 2.5);
  return {away * std::cos(angle), away * std::sin(angle)};
}

/// (6.7) of a bearing of a known landmark, by the camera's position: the mean over the noise of second differences.
Claim sign() {
  RandomStream random(1, "section-6.1.2");
  Worst worst;  // relative
  double most = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < layouts; ++i) {
    const Vector2d landmark = drawn_point(random);
    const auto bearing = [&](const Vector2d& at) {
      return Bearing::predict_measurement(planar::Pose<double>(at.x(), at.y(), 0), landmark)->z[0];
    };
    constexpr double h = 1e-3;
    const double variance = sigma_bearing * sigma_bearing, there = bearing(Vector2d::Zero());
    Matrix2d mean = Matrix2d::Zero();
    for (const double w : {-sigma_bearing, sigma_bearing}) {  // exact, log p being quadratic in the noise
      const auto log_p = [&](double x, double y) {
        return -std::pow(there + w - bearing({x, y}), 2) / (2 * variance);
      };
      Matrix2d second;
      second(0, 0) = log_p(h, 0) - 2 * log_p(0, 0) + log_p(-h, 0);
      second(1, 1) = log_p(0, h) - 2 * log_p(0, 0) + log_p(0, -h);
      second(0, 1) = second(1, 0) = (log_p(h, h) - log_p(h, -h) - log_p(-h, h) + log_p(-h, -h)) / 4;
      mean += second / (2 * h * h);
    }
    const Eigen::RowVector2d H =
        Bearing::predict_measurement(planar::Pose<double>(0, 0, 0), landmark)->Hv.leftCols<2>();
    const Matrix2d information = H.transpose() * H / variance;
    worst.take((mean - information).norm() / information.norm(),
               (-mean - information).norm() / information.norm());
    most = std::max(most, mean.trace());
  }
  return assessed("6.7-sign", "(6.7)",
                  "(6.7) is the Fisher information, H' R^-1 H of a bearing; to 1e-3 of it",
                  {.printed = "F(x) = E[d^2/dx^2 log p(z|x)]",
                   .measured = {"of {} landmarks, relative: {}; the largest trace of (6.7) is {:.3g}",
                                layouts, worst.text(), most},
                   .number = exactly("largest difference of (6.7), relative", worst.printed),
                   .why = "with a minus: the mean of the second derivative is negative, and information is "
                          "not",
                   .runs = layouts},
                  worst, 1e-3);
}

/// Largest difference from 1 of an eigenvalue of the information F in units of P^-1.
double off_inverse(const MatrixXd& F, const MatrixXd& P) {
  const MatrixXd root = P.llt().matrixL();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> in_units(root.transpose() * F * root);
  return (in_units.eigenvalues().array() - 1).abs().maxCoeff();
}

struct Inverse {
  double by_S = 0, by_R = 0;  ///< how far the sum is from P^-1
};

/// A landmark that is measured from known positions around.
Inverse of_landmark(int measurements) {
  RandomStream random(2, "section-6.1.2");
  const Vector2d landmark(2.2, 0.3);
  const double R = sigma_bearing * sigma_bearing;
  Matrix2d P = 0.25 * Matrix2d::Identity(), by_S = Matrix2d::Zero(), by_R = by_S;
  for (int i = 0; i < measurements; ++i) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    const Eigen::RowVector2d H = Bearing::predict_measurement(planar::Pose<double>(x, y, 0), landmark)->Hl;
    const double S = H * P * H.transpose() + R;
    by_S += H.transpose() * H / S, by_R += H.transpose() * H / R;
    P -= Matrix2d(P * H.transpose() * H * P / S);
  }
  return {off_inverse(by_S, P), off_inverse(by_R, P)};
}

/// The monobot with an anchor and a landmark, whose F is I.
Inverse of_monobot(int steps) {
  const monobot::Setup setup{.anchored = true, .steps = steps};
  const LinearSystem s = monobot::system(setup);
  const monobot::Course course = monobot::course(setup);
  MatrixXd by_S = MatrixXd::Zero(s.F.rows(), s.F.rows()), by_R = by_S;
  for (std::size_t k = 1; k < course.prior.size(); ++k) {  // there is none before the first step
    const MatrixXd S = s.H * course.prior[k] * s.H.transpose() + s.R;
    by_S += s.H.transpose() * S.inverse() * s.H, by_R += s.H.transpose() * s.R.inverse() * s.H;
  }
  return {off_inverse(by_S, course.posterior.back()), off_inverse(by_R, course.posterior.back())};
}

Claim limit() {
  const Inverse few = of_landmark(100), many = of_landmark(10000), moving = of_monobot(1000),
                longer = of_monobot(10000);
  return assessed(
      "6.8-limit", "below (6.8)",
      "In the limit the Fisher information, the sum of (6.8), is P^-1: within 1 % in every direction after "
      "10000 measurements of SLAM with an anchor (monobot)",
      {.rule = Rule::equality,
       .measured = {"farthest from P^-1 in any direction: monobot {:.3g} after 1000 and {:.3g} times after "
                    "10000 steps; a landmark measured from known places {:.2g} after 100 and {:.2g} after "
                    "10000, with R in place of S {:.2g} and {:.2g}",
                    moving.by_S, longer.by_S, few.by_S, many.by_S, few.by_R, many.by_R},
       .number = exactly("sum (6.8) over P^-1, less 1, monobot after 10000 steps", longer.by_S),
       .why =
           "of what stands still. Of a robot that moves the sum grows for ever, and its P does not vanish"},
      longer.by_S < 0.01, on_condition(many.by_S < 0.01 && many.by_R < 0.01 && longer.by_S > moving.by_S));
}

/// (6.8), the same with R, and mutual information, of a measurement of a landmark with that covariance.
std::array<double, 3> metrics(const Vector2d& landmark, const Matrix2d& covariance) {
  Plane plane({landmark});
  plane.know(0, covariance);
  const InformationGain gain = plane.gain_of(plane.step_to({0, 0}));
  return {gain.fisher_trace(), gain.fisher_trace_given_state(), gain.of_state()};
}

Matrix2d along_ray(const Vector2d& landmark, double along_m, double across_m) {
  const Vector2d ray = landmark.normalized();
  return across_m * across_m * Matrix2d::Identity() +
         (along_m * along_m - across_m * across_m) * ray * ray.transpose();
}

Claim prefers_uncertain() {
  RandomStream random(3, "section-6.1.2");
  int preferred = 0;
  Extremes fresh_over_known, vague_over_known, by_R, more_nats;
  for (int i = 0; i < layouts; ++i) {
    const Vector2d at = drawn_point(random);
    const auto known = metrics(at, along_ray(at, 0.01, 0.01)), fresh = metrics(at, along_ray(at, 0.8, 0.02)),
               vague = metrics(at, along_ray(at, 0.5, 0.5));
    preferred += fresh[0] > known[0];
    fresh_over_known.take(fresh[0] / known[0]), vague_over_known.take(vague[0] / known[0]);
    by_R.take(fresh[1] / known[1]), more_nats.take(vague[2] - known[2]);
  }
  const bool depth_does_not_matter = fresh_over_known.least > 0.9 && fresh_over_known.most < 1.1;
  return assessed(
      "6.8-uncertain", "(6.8), Sections 6.1.2 and 6.3.1",
      "The Fisher information of (6.8), H' S^-1 H, is greatest where the landmark is the most uncertain: "
      "greater of a new landmark, whose depth is unknown, than of a well-known one, in at least 95 %",
      {.rule = Rule::frequency,
       .measured =
           {"greater of {} of {} new landmarks; (6.8) {:.3f} to {:.3f} times that of well-known ones, "
            "with R in place of S {:.3f} to {:.3f}. Of landmarks known to 0.5 m in all directions "
            "(6.8) is {:.2f} to {:.2f} times as great, mutual information {:.2f} to {:.2f} nats more",
            preferred, layouts, fresh_over_known.least, fresh_over_known.most, by_R.least, by_R.most,
            vague_over_known.least, vague_over_known.most, more_nats.least, more_nats.most},
       .number =
           exactly("(6.8) of a new landmark over that of a well-known one, at most", fresh_over_known.most),
       .why = "what is unknown along the ray does not show in the image, so that (6.8) is nearly the same. "
              "Uncertainty that does show makes S larger and (6.8) smaller; mutual information grows with it",
       .runs = layouts},
      happens_in(0.95, preferred, layouts),
      in_truth(depth_does_not_matter && vague_over_known.most < 1 && more_nats.least > 0));
}

/// How near to the landmark the most informative of the actions leads; least 0, when it is the nearest of all.
double farther_than_need_be_m(Plane& plane, double (InformationGain::*metric)() const) {
  double best = -1, at_best = 0, nearest = std::numeric_limits<double>::infinity();
  for (int d = -180; d < 180; d += 3) {
    const ImaginedStep step = plane.step_to(way(d));
    const double value = step.measurements.empty() ? 0 : (plane.gain_of(step).*metric)(),
                 distance = (plane.points[0] - way(d)).norm();
    nearest = std::min(nearest, distance);
    if (value > best) best = value, at_best = distance;
  }
  return at_best - nearest;
}

Claim moves_close() {
  struct Count {
    int nearest = 0, away = 0;
  };
  Count uncertain, known, given_state;
  RandomStream random(4, "section-6.1.2");
  for (int i = 0; i < layouts; ++i) {
    const Vector2d at = drawn_point(random);
    Plane vague({at}), sure({at});
    sure.know(0, along_ray(at, 0.01, 0.01));
    const auto take = [](Count& count, double farther) {
      count.nearest += farther<0.01, count.away += farther> 0.5;
    };
    take(uncertain, farther_than_need_be_m(vague, &InformationGain::fisher_trace));
    take(known, farther_than_need_be_m(sure, &InformationGain::fisher_trace));
    take(given_state, farther_than_need_be_m(vague, &InformationGain::fisher_trace_given_state));
  }
  return assessed(
      "6.8-close", "end of Section 6.1.2",
      "By the Fisher information (6.8) the most informative actions move as close as possible to the landmark "
      "that is observed: within 1 cm, in at least 95 % of the layouts",
      {.rule = Rule::frequency,
       .measured =
           {"of {} layouts as close as possible, and away from it: landmark known to 0.5 m {} and {}, "
            "to 1 cm {} and {}; with R in place of S {} and {}",
            layouts, uncertain.nearest, uncertain.away, known.nearest, known.away, given_state.nearest,
            given_state.away},
       .number = exactly("layouts in which (6.8) moves away from a landmark known to 0.5 m, of 100",
                         uncertain.away),
       .why =
           "with R in place of S, the Fisher information of a measurement given the state. Nearer by, what "
           "is unknown of the positions is seen under a larger angle, and S grows with it",
       .runs = layouts},
      happens_in(0.95, uncertain.nearest, layouts) && happens_in(0.95, known.nearest, layouts),
      on_condition(happens_in(0.95, given_state.nearest, layouts)));
}

}  // namespace

std::vector<Claim> fisher_claims() { return {sign(), limit(), prefers_uncertain(), moves_close()}; }

}  // namespace incognita::section_6_1_plane
