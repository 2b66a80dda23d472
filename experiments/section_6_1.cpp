// Figure 6.2 and Section 6.1: the information gain of the camera of section_6_1.hpp, and what entropy and mutual
// information are.
#include "experiments/section_6_1.hpp"

#include <array>
#include <ranges>
#include <utility>

#include "experiments/common.hpp"
#include "incognita/math/gaussian.hpp"
#include "incognita/models/sensors/bearing.hpp"

namespace incognita {
namespace section_6_1_plane {

Plane::Plane(std::vector<Vector2d> places) : points(std::move(places)) {
  camera = belief.add_vehicle(DifferentialDrive::chart, Vector3d::Zero(),
                              Vector3d(0.04, 0.04, std::pow(5 * pi / 180, 2)).asDiagonal().toDenseMatrix());
  for (const Vector2d& at : points)
    blocks.push_back(belief.augment(Chart::line(2), at, {}, 0.25 * Matrix2d::Identity()));
}

void Plane::know(std::size_t landmark, const Matrix2d& covariance) {
  belief.replace(blocks[landmark], Chart::line(2), points[landmark], BlockMatrix::Zero(2, 2),
                 BlockMatrix(covariance));
}

ImaginedStep Plane::step_to(const Vector2d& position) const {
  ImaginedStep step{BlockMatrix::Identity(3, 3), 1e-4 * BlockMatrix::Identity(3, 3), {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto prediction =
        Bearing::predict_measurement(planar::Pose<double>(position.x(), position.y(), 0), points[i]);
    if (!prediction || std::abs(prediction->z[0]) > pi / 2) continue;
    PredictedMeasurement measurement;
    measurement.of = PredictedMeasurement::Of::mapped;
    measurement.block = blocks[i];
    measurement.Hv = prediction->Hv;
    measurement.Hl = prediction->Hl;
    measurement.R = sigma_bearing * sigma_bearing * MeasurementMatrix::Identity(1, 1);
    step.measurements.push_back(measurement);
  }
  return step;
}

InformationGain Plane::gain_of(const ImaginedStep& step) const {
  InformationGain gain;
  gain.start(belief, camera);
  gain.push(step);
  return gain;
}

void Plane::measure_at(const Vector2d& position) {
  const ImaginedStep step = step_to(position);
  belief.predict({camera, Vector3d(position.x(), position.y(), 0), step.A, step.N});
  std::vector<LinearizedMeasurement> seen;
  for (const PredictedMeasurement& measurement : step.measurements) {
    LinearizedMeasurement affine;
    affine.add(camera, measurement.Hv);
    affine.add(measurement.block, measurement.Hl);
    affine.residual = MeasurementVector::Zero(1);
    affine.R = measurement.R;
    seen.push_back(affine);
  }
  belief.update(seen);
}

Vector2d way(double degrees) {
  return 0.5 * Vector2d(std::cos(degrees * pi / 180), std::sin(degrees * pi / 180));
}

Plane drawn_landmarks(RandomStream& random) {
  std::vector<Vector2d> places;  // to the left, ahead, and to the right
  for (const auto& [from, to] : {std::pair(70, 100), std::pair(-10, 15), std::pair(-60, -25)}) {
    const double angle = random.uniform(from, to) * pi / 180, away = random.uniform(1, 2.5);
    places.emplace_back(away * std::cos(angle), away * std::sin(angle));
  }
  return Plane(places);
}

void measure_often(Plane& plane, int measurements, RandomStream& random) {
  for (int i = 0; i < measurements; ++i) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    plane.measure_at({x, y});
  }
}

}  // namespace section_6_1_plane

namespace {

using namespace section_6_1_plane;

/// (6.6) by the determinants of the whole covariance, before and after.
double by_determinants(const Plane& plane, const Vector2d& position) {
  const ImaginedStep step = plane.step_to(position);
  MatrixXd P = plane.belief.dense_covariance();
  P.topLeftCorner(3, 3) += step.N;
  MatrixXd H = MatrixXd::Zero(static_cast<Index>(step.measurements.size()), P.cols());
  for (std::size_t i = 0; i < step.measurements.size(); ++i) {
    H.block(static_cast<Index>(i), 0, 1, 3) = step.measurements[i].Hv;
    H.block(static_cast<Index>(i), plane.belief.offset(step.measurements[i].block), 1, 2) =
        step.measurements[i].Hl;
  }
  const MatrixXd S =
      H * P * H.transpose() + sigma_bearing * sigma_bearing * MatrixXd::Identity(H.rows(), H.rows());
  const MatrixXd after = P - P * H.transpose() * S.inverse() * H * P;
  return 0.5 * std::log(P.determinant() / after.determinant());
}

Plot figure(const Plane& plane) {
  Panel map{"(a) from above", "x, m", "y, m", {}, true};
  std::vector<int> directions;
  for (int d = -180; d <= 180; d += 3) directions.push_back(d);
  const auto gain = [&](int d) { return plane.gain_at(way(d)); };
  const double least = std::ranges::min(directions | std::views::transform(gain));
  const auto drawn = [&](int d) -> Vector2d { return 2 * (0.1 + 0.25 * (gain(d) - least)) * way(d); };
  Panel by_angle{"(b) by direction", "degrees to the left", "nats", {}};
  map.curves = {ellipses("2 sigma", plane.points, std::vector<Matrix2d>(3, 0.25 * Matrix2d::Identity())),
                path_of("landmarks", Style::stars, Color::ink, plane.points),
                path_of("gain, 0.25 m a nat", Style::line, Color::blue, directions, drawn)};
  by_angle.curves = {curve_of("I(X; Z)", Style::line, Color::blue, directions, std::identity(), gain)};
  return {"fig-6.2",
          "Information gain of moving 0.5 m in any direction for a camera on a plane",
          2,
          {map, by_angle}};
}

/// Figure 6.3: the covariance of camera and map, extended by expected landmarks, known to nothing but 5 m^2.
Plot extended_covariance() {
  constexpr int expected = 4;
  RandomStream random(3, "figure-6.3");
  Plane plane;
  measure_often(plane, 10, random);
  const MatrixXd P = plane.belief.dense_covariance();
  const auto n = static_cast<int>(P.rows()), all = n + 2 * expected;
  MatrixXd extended = 5 * MatrixXd::Identity(all, all);
  extended.topLeftCorner(n, n) = P;
  Curve mapped{"camera and map", Style::circles, {}, {}, {}, Color::blue},
      unmapped{"expected landmarks", Style::circles, {}, {}, {}, Color::orange};
  std::vector<Curve> sigmas{mapped, unmapped};
  for (int i = 0; i < all; ++i) {
    Curve& sigma = sigmas[i < n ? 0 : 1];
    sigma.x.push_back(i + 1), sigma.y.push_back(std::sqrt(extended(i, i)));
    for (int j = 0; j < all; ++j) {
      if (extended(i, j) == 0) continue;
      Curve& entries = i < n ? mapped : unmapped;
      entries.x.push_back(j + 1), entries.y.push_back(all - 1 - i);
    }
  }
  Panel entries{"(a) entries other than zero", "column", "row", {mapped, unmapped}, true};
  entries.x_range = {0.5, all + 0.5}, entries.y_range = {-0.5, all - 0.5};
  for (int row = all; row > 0; --row) entries.y_names.push_back(std::to_string(row));
  Panel states{"(b) sigma by state", "state", "m or rad", sigmas};
  states.log_y = true, states.x_range = entries.x_range;
  return {"fig-6.3",
          "Covariance of a camera and its map, extended by four expected landmarks",
          2,
          {entries, states}};
}

int best_way(const Plane& plane) {
  int best = 0;
  for (int d = -180; d < 180; d += 3)
    if (plane.gain_at(way(d)) > plane.gain_at(way(best))) best = d;
  return best;
}

Claim where_it_is_best(const Plane& plane) {
  constexpr int layouts = 100;
  int between = 0;
  RandomStream random(2, "figure-6.2");
  for (int i = 0; i < layouts; ++i) {
    const Plane other = drawn_landmarks(random);
    const int best = best_way(other);
    between += best < direction_of(other.points[1]) && best > direction_of(other.points[2]);
  }
  return assessed("6.2-between", "Figure 6.2",
                  "There are such layouts: of three landmarks to the left, in front and to the right, moving "
                  "between the second and the third is the most informative",
                  {.rule = Rule::example,
                   .measured = {"in {} of {} layouts; in the drawn one best at {} degrees, {:.2f} nats, "
                                "landmarks at {:.0f}, {:.0f} and {:.0f} degrees",
                                between, layouts, best_way(plane), plane.gain_at(way(best_way(plane))),
                                direction_of(plane.points[0]), direction_of(plane.points[1]),
                                direction_of(plane.points[2])},
                   .number = exactly("layouts in which it is so, of 100", between),
                   .runs = layouts},
                  between > 0);
}

/// (6.4) against (6.5), of random tables.
Claim conditional_entropy() {
  RandomStream random(4, "section-6.1");
  constexpr int tables = 100;
  Worst worst;
  for (int i = 0; i < tables; ++i) {
    MatrixXd p = MatrixXd::NullaryExpr(3, 4, [&] { return random.uniform(0.1, 1); });  // by x and z
    p /= p.sum();
    const Eigen::RowVectorXd of_z = p.colwise().sum();
    const MatrixXd given = p * of_z.cwiseInverse().asDiagonal();
    const auto entropy = [](const MatrixXd& q) { return -(q.array() * q.array().log()).sum(); };
    const double truth = entropy(p) - entropy(of_z), sum = (p.array() * given.array().log()).sum();
    worst.take(std::abs(sum - truth), std::abs(-sum - truth));
  }
  return assessed("6.1-conditional", "(6.4), (6.5)",
                  "(6.4) is the conditional entropy, H(X, Z) - H(Z) of (6.5); to 1e-12",
                  {.printed = "H(X|Z) = sum p(x, z) log p(x|z)",
                   .measured = {"of {} random tables: {}", tables, worst.text("nats")},
                   .number = exactly("largest difference of (6.4) from (6.5)", worst.printed, "nats"),
                   .why = "with a minus: H(X|Z) = - sum p(x, z) log p(x|z). (6.5) follows from that",
                   .runs = tables},
                  worst, 1e-12);
}

/// (6.6): the printed determinants, ours, and that measurements lose no information.
std::vector<Claim> identities(const Plane& plane) {
  double apart = 0, least = 1e9;
  RandomStream random(6, "section-6.1");
  for (int i = 0; i < 1000; ++i) {
    const Vector2d position(random.uniform(-1, 1), random.uniform(-1, 1));
    const double ours = plane.gain_at(position), theirs = by_determinants(plane, position);
    apart = std::max(apart, std::abs(ours - theirs) / (1 + theirs));
    least = std::min(least, ours);
  }
  const double none = plane.gain_at({50, 0});
  const MatrixXd large = 1e-4 * MatrixXd::Identity(313, 313);
  // A Gaussian known exactly but for one number of variance v: -sum p log p is half of 1 + log 2 pi v
  const double variance = 0.3;
  const auto p = [&](double x) { return std::exp(-x * x / (2 * variance)) / std::sqrt(2 * pi * variance); };
  double integral = 0;
  for (double x = -8; x < 8; x += 1e-3) integral -= 1e-3 * p(x) * std::log(p(x));
  const double printed = 0.5 * std::log(2 * pi * variance), ours = gaussian_entropy(std::log(variance), 1);
  return {
      assessed("6.6-identity", "(6.6)",
               "Mutual information is half the difference of log|P| before and after; to 1e-9",
               {.measured = {"1000 positions: against (log|S| - log|R|)/2, which needs no posterior, at most "
                             "{} apart. |P| of 313 states known to 1 cm each is {} in double precision, so "
                             "the difference is computed from factors",
                             below(apart), large.determinant()}},
               apart < 1e-9),
      assessed("6.6-positive", "below (6.6)",
               "Mutual information is always positive: measurements lose no information",
               {.rule = Rule::example,
                .measured = {"least of 1000 positions {:.3g} nats; of none in view exactly {}", least, none},
                .number = exactly("least information gain of a measurement", least, "nats")},
               least > 0 && none >= 0),
      assessed(
          "6.2-entropy", "(6.1), (6.2)", "The entropy of a Gaussian is half of log((2 pi)^n |P|); to 1e-6",
          {.printed = "1/2 log((2 pi)^n |P|)",
           .measured = {"of variance 0.3: integral {:.6f}, printed {:.6f}, with e {:.6f} nats", integral,
                        printed, ours},
           .number = exactly("difference of the printed entropy", std::abs(integral - printed), "nats"),
           .why =
               "with e: half of log((2 pi e)^n |P|). Differences of entropies, all that decides, are right"},
          std::abs(integral - printed) < 1e-6, as_corrected(std::abs(integral - ours) < 1e-6))};
}

/// Over all directions, nats: the largest information gain about the map; and how much less than the best gain
/// is that of the direction that is best for the camera alone, and for the camera given the map.
Eigen::Array3d gains_of_all_directions(const Plane& plane) {
  const BlockMatrix given_map = vehicle_given_map(plane.belief, plane.camera);
  std::vector<double> all, own, own_given_map, of_map;
  for (int d = -180; d < 180; d += 3) {
    const InformationGain gain = plane.gain_of(plane.step_to(way(d)));
    all.push_back(gain.of_state());
    own.push_back(gain.of_vehicle());
    of_map.push_back(gain.of_position_and_map(0, given_map));
    own_given_map.push_back(all.back() - of_map.back());
  }
  const auto lost_by = [&](const std::vector<double>& choice) {
    return std::ranges::max(all) -
           all[static_cast<std::size_t>(std::ranges::max_element(choice) - choice.begin())];
  };
  return {std::ranges::max(of_map), lost_by(own), lost_by(own_given_map)};
}

/// In layouts like that of Figure 6.2.
Claim once_correlated() {
  constexpr int layouts = 30, measurements = 1500;
  Eigen::Array3d worst = Eigen::Array3d::Zero();
  RandomStream random(7, "section-6.1");
  for (int i = 0; i < layouts; ++i) {
    Plane plane = drawn_landmarks(random);
    measure_often(plane, measurements, random);
    worst = worst.max(gains_of_all_directions(plane));
  }
  const auto [of_map, lost_by_own, lost_by_own_given_map] = std::array{worst[0], worst[1], worst[2]};
  return assessed(
      "6.1-fully-correlated", "end of Section 6.1.1",
      "Once the map is fully correlated there is no information left to gain about it, and the camera's own "
      "entropy is enough to decide by: its best direction has as much information gain as any, to 0.01 nats",
      {.printed = "replacing x with x_r",
       .measured = {"worst of {} layouts after {} measurements from all around: {:.4f} nats of the map, by "
                    "the camera's choice {:.3f} nats less than by the best, by its choice given the map "
                    "{:.4f}; in a map not measured yet {:.2f} nats of the map",
                    layouts, measurements, of_map, lost_by_own, lost_by_own_given_map,
                    gains_of_all_directions(Plane())[0]},
       .number = exactly("information lost by the camera's own entropy, worst layout", lost_by_own, "nats"),
       .why = "if it is the camera's entropy given the map. Its own also has the position of camera and map "
              "together",
       .runs = layouts},
      of_map < 0.01 && lost_by_own < 0.01, on_condition(of_map < 0.01 && lost_by_own_given_map < 0.01));
}

LedgerEntry run_section_6_1(const ExperimentSettings& settings) {
  const Plane plane;
  return entry_of(
      section_6_1, settings,
      {identities(plane), conditional_entropy(), where_it_is_best(plane), fisher_claims(), once_correlated(),
       choice_claims(10 * settings.seeds), surface_claims(10 * settings.seeds)},
      {figure(plane), extended_covariance()});
}

}  // namespace

const Experiment section_6_1{
    "6.1", "What metrics of information say", {"fig-6.2", "fig-6.3"}, run_section_6_1};

}  // namespace incognita
