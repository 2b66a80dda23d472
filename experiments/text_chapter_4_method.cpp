// Claims in the running text of Chapter 4 about its method: the Gramian (4.1), SOM and TOM, one measurement,
// and motions without parallax.
//
// Experiment: the built-in systems, motions and rules of observability_claims.hpp. The Gramian over 1 s of
// frozen F and H, which Simpson's rule integrates exactly, as F is nilpotent; `planar` with one feature and
// four anchors, where H is square and H H' can be had. 100 random systems of six states, two of which are not
// observable, for (4.2). 20 segments of 0.05 s for short ones.
#include <limits>

#include "experiments/common.hpp"
#include "experiments/observability_claims.hpp"

namespace incognita::observability_claims {
namespace {

MatrixXd gramian(const LinearizedSystem& form, const MatrixXd& inner) {
  const auto at = [&](double t) -> MatrixXd {
    const MatrixXd moved = MatrixXd::Identity(form.F.rows(), form.F.cols()) + t * form.F;  // F F = 0
    return moved.transpose() * inner * moved;
  };
  return (at(0) + 4 * at(0.5) + at(1)) / 6;
}

Claim gramian_claim() {
  const Study& s = study({.system = "planar", .anchors = 4});
  const auto with = [&](const std::function<MatrixXd(const MatrixXd&)>& inner) {
    return null_spaces(s, [&](const Course& c) { return gramian(c.forms[0], inner(c.forms[0].H)); });
  };
  const Spaces printed = with([](const MatrixXd&H) { return H * H.transpose(); }),
               corrected = with([](const MatrixXd&H) { return H.transpose() * H; });
  const bool is_that = same(printed, s.stripped(1)), ours_is = same(corrected, s.stripped(1));
  return studied(
      "text-4-gramian", "(4.1)", "The null space of the Gramian is what cannot be observed: that of (4.2)",
      {.rule = Rule::dimension,
       .printed = "integral of exp(F' tau) H H' exp(F tau)",
       .measured = {"Q_1 leaves {} in {} motions (one feature, four anchors, where H is square); the Gramian "
                    "with H H' {}, {}; with H' H {}, {}",
                    s.left(1), motions, joined({dimension(printed)}), is_that ? "the same" : "not the same",
                    joined({dimension(corrected)}), ours_is ? "the same" : "not the same"},
       .number = number_of("dimensions that the Gramian with H H' leaves, where Q_1 leaves one",
                           dimension(printed)),
       .why = "H' H; with as many measurements as states H H' is another matrix, else the product does not "
              "exist"},
      is_that, as_corrected(ours_is));
}

MatrixXd some_matrix(RandomStream& random, Index rows, Index columns) {
  return MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

MatrixXd some_rotation(RandomStream& random, Index n) {
  return Eigen::HouseholderQR<MatrixXd>(some_matrix(random, n, n)).householderQ();
}

Claim steps() {
  constexpr int systems = 100, n = 6;
  RandomStream random(1, "systems");
  bool same_space = true;
  for (int i = 0; i < systems; ++i) {
    // two states that are neither measured nor influence the others
    MatrixXd F = MatrixXd::Zero(n, n), H = MatrixXd::Zero(1, n);
    F.topLeftCorner(4, 4) = some_rotation(random, 4);
    F.bottomLeftCorner(2, 4) = some_matrix(random, 2, 4),
                          F.bottomRightCorner(2, 2) = some_rotation(random, 2);
    H.leftCols(4) = some_matrix(random, 1, 4);
    const MatrixXd T = some_rotation(random, n);
    const auto left_after = [&](int count) {
      MatrixXd Q(count, n), row = H * T;
      for (int k = 0; k < count; ++k, row = (row * T.transpose() * F * T).eval()) Q.row(k) = row;
      return null_space(NoisyRows::exact(Q));
    };
    same_space = same_space && left_after(n).nullity == 2 && same({left_after(n)}, {left_after(5 * n)});
  }
  return assessed(
      "text-4-steps", "below (4.1)", "What is unobservable over n steps is unobservable over any number",
      {.rule = Rule::dimension,
       .measured =
           {"{} random systems of 6 states, 2 of them not observable: left after 6 and after 30 steps: {}",
            systems, same_space ? "2 in all" : "not the same in all"},
       .runs = systems},
      same_space);
}

std::vector<Case> many_cases() {
  std::vector<Case> all;
  for (const char* system : {"planar", "planar-rb", "planar-cv", "inertial", "inertial-rb", "cv6"}) {
    for (const int anchors : {0, 1, 2, 3}) all.push_back({.system = system, .anchors = anchors});
    if (std::string(system) == "cv6") continue;
    for (const int features : {1, 2, 3}) all.push_back(relative_map(system, features));
  }
  return all;
}

Claim condition() {
  int met = 0, kept = 0, others = 0, others_kept = 0;
  for (const Case& which : many_cases()) {
    const Study& s = study(which);
    const bool equal = for_all({1, 2, 3}, [&](int k) { return s.same_spaces(k); });
    if (s.stays())
      ++met, kept += equal;
    else
      ++others, others_kept += s.dimensions() == s.total_dimensions();
  }
  return studied(met + others, "text-4-condition", "(4.9), (4.10)",
                 "Where N(Q_j) is within N(F_j), SOM and TOM have the same null space",
                 {.rule = Rule::dimension,
                  .measured = {"(4.9) holds in {} of {} cases, in {} of them the null spaces are the same; "
                               "of the other {} cases the dimensions are in {}",
                               met, met + others, kept, others, others_kept},
                  .number = exactly(fmt::format("cases of {} in which (4.9) holds and the null spaces differ",
                                                met + others),
                                    met - kept)},
                 met > 0 && met == kept);
}

Claim piecewise() {
  Studies all("systems and anchors");
  for (const char* system : {"planar", "planar-cv", "inertial", "cv6"})
    for (const int anchors : {0, 1})
      all.add(fmt::format("{}, {}:", system, anchors), study({.system = system, .anchors = anchors}));
  const auto left = all.each([](const Study&s) { return dimension(s.total(3)); }),
             truly = all.each(&Study::true_dimension),
             by_lie = all.each([](const Study&s) { return dimension(lie(s.which(), 1)); });
  const bool too_few =
      std::ranges::equal(left, truly, [](int a, int b) { return a != no_dimension && a < b; });
  const Study &planar = study({.system = "planar"}),
              &fine = study({.system = "planar", .segments = 20, .segment_s = 0.05});
  const int of_fine = dimension(fine.total(20));
  const bool no_better = of_fine != no_dimension && of_fine < fine.true_dimension(),
             frozen = seen_by_frozen_rows_only(planar, named({"rotation"}));
  return studied(
      9, "text-4-piecewise", "below (4.2), of [55]",
      "Piecewise constant segments keep the characteristic behavior: the TOM leaves what the motion itself "
      "leaves",
      {.rule = Rule::dimension,
       .measured = {"left by the TOM of three segments {}, by the motion {}, by Lie derivatives {} (planar, "
                    "planar-cv, inertial, cv6 with 0 and 1 anchors). 20 short segments of planar: {} and {}. "
                    "The turn of all changes H F, but neither H nor a measurement: {}",
                    joined(left), joined(truly), joined(by_lie), joined({of_fine}),
                    joined({fine.true_dimension()}), yes_no(frozen)},
       .number =
           number_of("dimensions left by the TOM of planar, where the motion itself leaves three", left[0]),
       .why = "SOM and TOM have too high a rank: H is frozen in a segment while F moves the vehicle, so that "
              "H F is not the change of H. Shorter segments do not help"},
      left == truly && by_lie == truly && of_fine == fine.true_dimension(),
      in_truth(too_few && by_lie == truly && frozen && no_better));
}

Claim one_measurement() {
  int least = std::numeric_limits<int>::max();
  bool Q_1_never = true;
  std::vector<std::string> lines;
  for (const char* system : {"planar", "inertial", "planar-cv", "cv6"}) {
    const auto left = each_of({0, 1, 2, 3}, [&](int anchors) {
      const Study& s = study({.system = system, .anchors = anchors});
      const int by_one = dimension(null_spaces(s, [](const Course& c) { return c.exact[0].H; }));
      least = std::min(least, by_one);
      Q_1_never = Q_1_never && s.left(1) > 0;
      return by_one;
    });
    lines.push_back(fmt::format("{} {}", system, joined(left)));
  }
  return studied(16, "text-4-one-look", "head of Chapter 4",
                 "One measurement step leaves bearing-only SLAM unobservable",
                 {.rule = Rule::dimension,
                  .measured = {"dimensions left by one measurement of one feature, with 0/1/2/3 anchors: {}; "
                               "Q_1 leaves some, too: {}",
                               fmt::join(lines, "; "), Q_1_never ? "always" : "not always"},
                  .number = number_of("fewest dimensions left by one measurement, of 16 systems", least)},
                 InTruth{least > 0}, ByMethod{Q_1_never});
}

std::vector<Claim> without_parallax() {
  const Vectors distance = named({"depth"});
  Studies turned("with three anchors, turning on the spot");
  for (const char* system : {"planar", "cv6"})
    turned.add(system, study({.system = system, .anchors = 3, .motion = "stationary", .change = turning()}));
  const auto left_along = [&](const Study& s) { return s.along_spanned_by(distance); };
  const auto left_by_som = [&](const Study& s) { return s.stripped_spanned_by(3, distance); };
  Case straight{.system = "planar", .anchors = 2, .motion = "straight"};
  const Study& aside = study(straight);
  straight.change = feature_within("ahead", {5, 9}, {0, 0});
  const Study& ahead = study(straight);
  return {
      studied(turned.cases(), "text-4-turning", "head of Chapter 4",
              "A purely rotating camera has no information about the distance of a feature, however well its "
              "pose is known by anchors",
              {.rule = Rule::dimension,
               .measured = {"{}; what is left is the distance: {}", turned.text(),
                            yes_no(turned.all(left_along))},
               .number = left_in_truth(*turned.begin(), ", on the plane: the distance")},
              InTruth{turned.all(left_along)}, ByMethod{turned.all(left_by_som)}),
      studied(2, "text-4-line-of-sight", "head of Chapter 4",
              "The distance of a feature on the line along which the camera moves is not observable",
              {.rule = Rule::dimension,
               .measured = {"{}, with two anchors, straight on: {}; with the feature straight ahead {}: its "
                            "distance, {}",
                            legend, aside.numbers(), ahead.numbers(), yes_no(left_along(ahead))},
               .number = left_in_truth(ahead, ", with the feature straight ahead and two anchors")},
              InTruth{left_along(ahead) && fully_observable(aside)},
              ByMethod{left_by_som(ahead) && full_in_two(aside)})};
}

}  // namespace

std::vector<Claim> method_claims() {
  return concatenated(
      {one_measurement(), without_parallax(), gramian_claim(), steps(), condition(), piecewise()});
}

}  // namespace incognita::observability_claims
