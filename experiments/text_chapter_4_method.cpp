// Claims in the running text of Chapter 4 about its method: the Gramian (4.1), SOM and TOM, one measurement,
// and motions without parallax.
//
// Experiment: the built-in systems, motions and rules of observability_claims.hpp. The Gramian over 1 s of
// frozen F and H, which Simpson's rule integrates exactly, as F is nilpotent; `planar` with one feature and
// four anchors, where H is square and H H' can be had. 100 random systems of six states, two of which are not
// observable, for (4.2). 20 segments of 0.05 s for short ones.
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
      {.printed = "with H H'",
       .measured = {"Q_1 leaves {} in {} motions (one feature, four anchors, where H is square); the Gramian "
                    "with H H' {}, {}; with H' H {}, {}",
                    s.left(1), motions, joined({dimension(printed)}), is_that ? "the same" : "not the same",
                    joined({dimension(corrected)}), ours_is ? "the same" : "not the same"},
       .why = "H' H; with as many measurements as states H H' is another matrix, else the product does not "
              "exist"},
      is_that, ours_is);
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
      {.measured =
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
                 {.measured = {"(4.9) holds in {} of {} cases, in {} of them the null spaces are the same; "
                               "of the other {} cases the dimensions are in {}",
                               met, met + others, kept, others, others_kept}},
                 met > 0 && met == kept);
}

/// Why SOM has a higher rank: the turn of all about the origin is in the null spaces of one measurement and
/// of the motion, but not in that of the row H F, in which H is frozen.
bool only_frozen_rows_see_the_turn() {
  const Study& s = study({.system = "planar"});
  const auto keeps = [&](const Spaces& spaces) { return contain(spaces, s.courses(), named({"rotation"})); };
  const auto of = [&](auto matrix) { return null_spaces(s, matrix); };
  return keeps(of([](const Course& c) { return c.forms[0].H; })) && keeps(s.along()) &&
         !keeps(of([](const Course& c) -> MatrixXd { return c.forms[0].H * c.forms[0].F; }));
}

Claim piecewise() {
  Studies all("systems and anchors");
  for (const char* system : {"planar", "planar-cv", "inertial", "cv6"})
    for (const int anchors : {0, 1})
      all.add(fmt::format("{}, {}:", system, anchors), study({.system = system, .anchors = anchors}));
  const auto left = all.each([](const Study&s) { return dimension(s.total(3)); }),
             in_truth = all.each([](const Study&s) { return s.true_dimension(); }),
             by_lie = all.each([](const Study&s) { return dimension(lie(s.which(), 1)); });
  const bool too_few =
      std::ranges::equal(left, in_truth, [](int a, int b) { return a != no_dimension && a <= b; });
  const Study& fine = study({.system = "planar", .segments = 20, .segment_s = 0.05});
  const int of_fine = dimension(fine.total(20));
  const bool turn = only_frozen_rows_see_the_turn(),
             no_better = of_fine != no_dimension && of_fine < fine.true_dimension();
  std::string why;
  if (too_few && left != in_truth && by_lie == in_truth && turn)
    why =
        "SOM and TOM have too high a rank: H is frozen in a segment while F moves the vehicle, so that H F "
        "is not the change of H";
  if (no_better) why += ". Shorter segments do not help";
  return studied(9, "text-4-piecewise", "below (4.2), of [55]",
                 "Piecewise constant segments keep the characteristic behavior: the TOM leaves what the "
                 "motion itself leaves",
                 {.printed = "no loss",
                  .measured = {"{}. Lie derivatives, at one point each, leave {} the motion does. 20 short "
                               "segments on the plane: SOM and TOM leave {} and {}, the motion {}. The turn "
                               "of all is observable by H F, but neither by H nor by the motion: {}",
                               all.text(), by_lie == in_truth ? "what" : "not what", joined({fine.left(20)}),
                               joined({of_fine}), joined({fine.true_dimension()}), yes_no(turn)},
                  .why = why},
                 left == in_truth && by_lie == in_truth && of_fine == fine.true_dimension());
}

Claim one_measurement() {
  bool never = true;
  std::vector<std::string> lines;
  for (const char* system : {"planar", "inertial", "planar-cv", "cv6"}) {
    const auto left = each_of({0, 1, 2, 3}, [&](int anchors) {
      const Study& s = study({.system = system, .anchors = anchors});
      const int by_one = dimension(null_spaces(s, [](const Course& c) { return c.forms[0].H; }));
      never = never && by_one > 0 && s.left(1) > 0;
      return by_one;
    });
    lines.push_back(fmt::format("{} {}", system, joined(left)));
  }
  return studied(16, "text-4-one-look", "head of Chapter 4",
                 "One measurement step leaves bearing-only SLAM unobservable",
                 {.printed = "unobservable",
                  .measured = {"dimensions left by one measurement of one feature, with 0/1/2/3 anchors: {}",
                               fmt::join(lines, "; ")}},
                 never);
}

std::vector<Claim> without_parallax() {
  Studies turned("with three anchors, turning on the spot");
  for (const char* system : {"planar", "cv6"})
    turned.add(system, study({.system = system, .anchors = 3, .motion = "stationary", .change = turning()}));
  const bool both = turned.all([](const Study& s) { return s.along_spanned_by(named({"depth"})); });
  Case straight{.system = "planar", .anchors = 2, .motion = "straight"};
  const Study& aside = study(straight);
  straight.change = feature_within("ahead", {5, 9}, {0, 0});
  const Study& s = study(straight);
  const bool distance_alone = s.along_spanned_by(named({"depth"}));
  return {
      studied(turned.cases(), "text-4-turning", "head of Chapter 4",
              "A purely rotating camera has no information about the distance of a feature, however well its "
              "pose is known by anchors",
              {.printed = "nothing",
               .measured = {"{}; what is left is the distance: {}", turned.text(), yes_no(both)}},
              both),
      studied(
          2, "text-4-line-of-sight", "head of Chapter 4",
          "The distance of a feature on the line along which the camera moves is not observable",
          {.printed = "does not",
           .measured =
               {"{}, with two anchors, straight on: {}; with the feature straight ahead {}: its distance, {}",
                legend, aside.numbers(), s.numbers(), yes_no(distance_alone)}},
          distance_alone && fully_observable(aside))};
}

}  // namespace

std::vector<Claim> method_claims() {
  return concatenated(
      {one_measurement(), without_parallax(), gramian_claim(), steps(), condition(), piecewise()});
}

}  // namespace incognita::observability_claims
