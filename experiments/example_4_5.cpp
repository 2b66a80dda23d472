// Example 4.5: Lie derivatives of the relative map of the plane, and the heading, which they leave
// unobservable.
//
// Experiment: the built-in systems `planar-polar` (range and bearing of the feature as states), `planar` and
// `planar-rb` in their relative forms, motions and rules of observability_claims.hpp; 1 to 3 features. The
// printed model is compared with (4.11) and exact derivatives of range and bearing; r may be x_f - p or p -
// x_f. Holds: beside those rules, formulas to 1e-9; of Lie derivatives all orders are taken, until none can
// add anything. (4.64) and (4.66) are tested on what the program derives symbolically, up to the third order,
// with the last term by five points.
#include <optional>

#include "experiments/common.hpp"
#include "experiments/observability_claims.hpp"
#include "incognita/analysis/systems/lie_algebra.hpp"
#include "incognita/io/formats/system_file.hpp"

namespace incognita::observability_claims {
namespace {

/// Range, bearing and heading of the feature where a motion begins, and how each input changes them.
struct Polar {
  double rho, phi;
  Vector3d by_v, by_omega;

  explicit Polar(const Course& course) {
    const SystemPoint& p = course.points[0];
    const double theta = p.x[0];
    rho = p.x.tail<2>().norm();
    phi = std::atan2(p.x[2], p.x[1]) - theta;
    const MatrixXd& H = course.exact[0].H;  // of range and bearing, by theta and r
    by_v << H * Vector3d(0, -std::cos(theta), -std::sin(theta)), 0;
    by_omega << H * Vector3d(1, 0, 0), 1;
  }
};

const Study& ranges_and_bearings() { return study(relative_map("planar-rb")); }

Case polar(int features = 1) { return relative_map("planar-polar", features); }

/// Largest difference of the fields of v and omega from what they must be; g1 by range and bearing, which is
/// turned by pi when r is p - x_f.
double wrong_fields(const std::function<Vector3d(double, double)>& g1, const Vector3d& g2, bool other_way) {
  return largest(ranges_and_bearings(), [&](const Course& course) {
    const Polar at(course);
    const double phi = at.phi + (other_way ? std::acos(-1.0) : 0);
    return std::max(apart(g1(at.rho, phi), at.by_v), apart(g2, at.by_omega));
  });
}

Claim model() {
  const auto g1 = [](double ahead, double turn) {
    return [=](double rho, double phi) -> Vector3d {
      return {ahead * std::cos(phi), std::sin(phi) / rho, turn};
    };
  };
  const auto either = [](const auto& by_v, const Vector3d& by_omega) {
    return std::min(wrong_fields(by_v, by_omega, false), wrong_fields(by_v, by_omega, true));
  };
  const double of_equations = either(g1(1, 0), Vector3d(0, -1, 1)),
               of_fields = either(g1(1, -1), Vector3d(0, 0, 1)),
               corrected = wrong_fields(g1(-1, 0), Vector3d(0, -1, 1), false);
  return studied(
      "4.5-model", "(4.69) to (4.73)", "The model in polar coordinates follows from (4.11), to 1e-9",
      {.printed = "rho' = v cos phi; g_1 = [cos phi, sin phi/rho, -1], g_2 = [0 0 1]",
       .measured = {"largest difference in {} motions, r = x_f - p or p - x_f: (4.69) to (4.71) "
                    "{:.2g}, (4.72) and (4.73) {:.2g}, ours {}",
                    motions, of_equations, of_fields, below(corrected)},
       .number = exactly("largest difference of the printed fields", std::max(of_equations, of_fields)),
       .why = "rho' = -v cos phi, phi' = (v/rho) sin phi - omega with r = x_f - p: g_1 = [-cos "
              "phi, sin phi/rho, 0], g_2 = [0, -1, 1]"},
      of_equations < rounding && of_fields < rounding, as_corrected(corrected < rounding));
}

Claim first_order() {
  const auto apart_from = [](const std::function<double(const Polar&)>& wrong) {
    return largest(ranges_and_bearings(), [&](const Course& c) { return std::abs(wrong(Polar(c))); });
  };
  const double first = apart_from([](const Polar&at) { return at.by_v[1] - std::sin(at.phi) / at.rho; }),
               second = apart_from([](const Polar&at) { return at.by_omega[1]; }),
               ours = apart_from([](const Polar&at) { return at.by_omega[1] + 1; });
  return studied(
      "4.5-first-order", "(4.74), (4.75)", "Lie derivatives of the bearing along both fields, to 1e-9",
      {.printed = "sin phi/rho, 0",
       .measured = {"largest difference in {} motions: the first {}, the second {:.2g}, from -1 {}", motions,
                    below(first), second, below(ours)},
       .number = exactly("largest difference of the second", second),
       .why = "the second is -1. Its differential is 0 all the same"},
      first < rounding && second < rounding, as_corrected(first < rounding && ours < rounding));
}

std::vector<Claim> left_by_lie() {
  const double difference = largest(study(polar()), [](const Course& course) {
    const SystemPoint& p = course.points[0];  // heading, range, bearing
    const double rho = p.x[1], phi = p.x[2];
    const Vector3d printed(0, -std::sin(phi) / (rho * rho), std::cos(phi) / rho);
    return apart(course.exact[0].F.row(2).transpose() / p.u[0], printed);
  });
  bool heading = true;
  const auto left = each_of({1, 2, 3}, [&](int features) {
    const Spaces spaces = lie(polar(features));
    heading = heading && are_basis(spaces, study(polar(features)).courses(),
                                   always({VectorXd::Unit(1 + 2 * features, 0)}));
    return dimension(spaces);
  });
  return {
      studied("4.5-rank", "(4.76)", "The differentials of all Lie derivatives span two of three dimensions",
              {.rule = Rule::dimension,
               .measured = {"rank {} at {} points, derivatives of all orders; largest difference of the "
                            "printed second column from d(sin phi/rho) {}",
                            3 - left[0], motions, below(difference)},
               .number = exactly("dimensions that the differentials span, of 3", 3 - left[0])},
              left[0] == 1 && difference < rounding),
      studied(3, "4.5-null-space", "(4.77), head of Chapter 4", "What they do not span is the orientation",
              {.rule = Rule::dimension,
               .measured = {"dimension with 1/2/3 features at {} points {}; the heading spans it: {}",
                            motions, joined(left), yes_no(heading)},
               .number = number_of("dimensions left by the Lie derivatives", left[0])},
              heading)};
}

Claim contrary() {
  const Case cartesian = relative_map("planar");
  const Study &s = study(cartesian), &in_polar = study(polar());
  const Vectors turned = named({"rotation"});
  const Spaces by_lie = lie(cartesian);
  const auto by_som = s.observable(2);
  const bool linear_finds_it = std::ranges::count(by_som, "theta") > 0,
             unseen = are_basis(by_lie, s.courses(), turned) && s.along_spanned_by(turned);
  return studied(
      2, "4.5-contrary", "below (4.77)",
      "The global orientation is not observable, contrary to the result of the linear analysis",
      {.rule = Rule::dimension,
       .measured = {"{} in {} motions: {}; by Lie derivatives {}: all turned, {}. By the SOM of two "
                    "segments observable: {}. In polar coordinates {}",
                    legend, motions, s.numbers(), joined({dimension(by_lie)}), yes_no(unseen), listed(by_som),
                    in_polar.numbers()},
       .number = number_of("dimensions left by the Lie derivatives", dimension(by_lie))},
      InTruth{unseen && linear_finds_it}, ByMethod{!linear_finds_it, in_truth(full_in_two(s))});
}

/// Lie derivatives of the first measurement of a landmark along the field of the input v, and where they are
/// evaluated: where a motion of the relative map begins, with that input 1 and the others 0.
class RepeatedLie {
 public:
  explicit RepeatedLie(const std::string& system)
      : algebra_(make_symbolic(load_system(system, "relative")), 0) {
    const auto& fields = algebra_.fields();
    const auto along = std::ranges::find_if(fields, [](const VectorField& f) { return f.name == "v"; });
    const int field = static_cast<int>(along - fields.begin());
    slots_.push_back(algebra_.system().landmark.measurements.at(0));
    while (slots_.size() <= orders) slots_.push_back(algebra_.derive(slots_.back(), field, {}));
    instance_.emplace(algebra_.system(), 1, 0);
  }

  /// L^q dh, as the gradient of L^q h.
  VectorXd differential(std::size_t q, const SystemPoint& point) const {
    VectorXd row;
    instance_->visit(point, true, [&](Owner owner, const SymbolicSystem::Block&, int, int, const auto& e) {
      if (owner == Owner::landmark) row = e.gradient.col(slots_[q]);
    });
    return row;
  }
  VectorXd g(const SystemPoint& point) const { return instance_->rate(point); }
  MatrixXd by_x(const SystemPoint& point) const { return instance_->rate_derivative(point); }

  static constexpr std::size_t orders = 3;

 private:
  LieAlgebra algebra_;
  std::vector<ExpressionGraph::Slot> slots_;
  std::optional<SystemInstance> instance_;
};

/// The last term of (4.66): how the differential changes along g, by five points.
VectorXd changed_along(const RepeatedLie& lie, std::size_t q, const SystemPoint& point) {
  constexpr double h = 1e-3;
  const VectorXd g = lie.g(point);
  const auto at = [&](double steps) {
    SystemPoint moved = point;
    moved.x += steps * h * g;
    return lie.differential(q, moved);
  };
  return (at(-2) - 8 * at(-1) + 8 * at(1) - at(2)) / (12 * h);
}

Claim recursion() {
  Worst worst;
  for (const char* system : {"planar", "planar-polar"}) {
    const RepeatedLie lie(system);
    for (const Course& course : study(relative_map(system)).courses()) {
      SystemPoint point = course.points[0];
      point.u = VectorXd::Unit(2, 0);
      for (std::size_t q = 1; q <= RepeatedLie::orders; ++q) {
        const VectorXd before = lie.differential(q - 1, point), last = changed_along(lie, q - 1, point),
                       quotient = before.cwiseProduct(lie.g(point)).cwiseQuotient(point.x);
        worst.take(quotient + last, lie.by_x(point).transpose() * before + last, lie.differential(q, point));
      }
    }
  }
  return studied(2, "4.5-recursion", "(4.64), (4.66)",
                 "The differential of a Lie derivative from the one before, orders 1 to 3, to 1e-9",
                 {.printed = "L_g^{q-1} dh(x) g(x)/x + ((d/dx (L_g^{q-1} dh(x))') g(x))'",
                  .measured = {"largest difference from gradients of L^q h along g_1 at {} points, in "
                               "Cartesian and polar coordinates: g/x entry by entry {:.2g}, ours {}",
                               motions, worst.printed, below(worst.ours)},
                  .number = exactly("largest difference of the printed form", worst.printed),
                  .why = "dg/dx for g(x)/x: the quotient is a derivative"},
                 worst, rounding);
}

LedgerEntry run_example_4_5(const ExperimentSettings& settings) {
  return entry_of(example_4_5, settings, {recursion(), model(), first_order(), left_by_lie(), contrary()});
}

}  // namespace
}  // namespace incognita::observability_claims

const incognita::Experiment incognita::example_4_5{
    "4.5", "Lie derivatives for the relative map of the plane", {}, observability_claims::run_example_4_5};
