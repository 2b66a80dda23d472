// How the information that actions promise changes while the camera measures, and what one iteration's (6.8) shows of
// it: Sections 2.4, 6.1.2 and 6.4.3.
//
// Experiment: the camera of section_6_1.hpp in random layouts. The plan, written before the runs:
// - flattening: it measures 100 times where the gain of one of 120 directions is the largest; the surface is flatter if
//   its largest less its smallest gain is less than before, in 95 % of the layouts;
// - pushed away: the largest gain is then more than 0.25 m away, in 95 % of the layouts;
// (It came out that the surface over all directions gets steeper and that only its top falls: that is tested as what is
//   true in place of "flatter". The two were one claim at first.)
// - order: seven actions are evaluated one in a frame, always in the same order or in random order, while the camera
//   stands and measures. A bias is a difference in how often the first action of the fixed order is chosen from when
//   all are evaluated at the same time: 0.03 of the choices or more (before the first run: above 0 for the fixed order);
// - eigenvalues: zero ones of H' S^-1 H of one iteration against those of the sum over 20 places. What is in the null
//   space of that sum cannot be observed, as camera and landmarks move together.
#include <numeric>

#include "experiments/common.hpp"
#include "experiments/section_6_1.hpp"

namespace incognita::section_6_1_plane {
namespace {

constexpr int drawn = 100, ways = 120, sets_of_actions = 7;

struct Information {
  Vector2d best;
  double top = 0, height = 0;  ///< nats: the largest gain, and how much more that is than the smallest
};

Information surface(const Plane& plane) {
  Information found;
  double most = -1, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < ways; ++i) {
    const Vector2d at = way(360.0 * i / ways);
    const double gain = plane.gain_at(at);
    least = std::min(least, gain);
    if (gain > most) most = gain, found.best = at;
  }
  found.top = most, found.height = most - least;
  return found;
}

/// What 100 measurements where the gain was the largest make of the surface.
struct Iterated {
  double height = 0,
         left_at_top = 0;  ///< of what they were: largest less smallest gain, the gain at that place
  double moved_m = 0;      ///< from that place to that of the largest gain
};

std::vector<Iterated> iterate_measurements() {
  std::vector<Iterated> all;
  RandomStream random(9, "section-2.4");
  for (int i = 0; i < drawn; ++i) {
    Plane plane = drawn_landmarks(random);
    const Information before = surface(plane);
    for (int k = 0; k < 100; ++k) plane.measure_at(before.best);
    const Information after = surface(plane);
    all.push_back({after.height / before.height, plane.gain_at(before.best) / before.top,
                   (after.best - before.best).norm()});
  }
  return all;
}

Claim flattened(const std::vector<Iterated>& all) {
  const auto flatter = std::ranges::count_if(all, [](const Iterated&i) { return i.height < 1; }),
             steeper_top_lower = std::ranges::count_if(
                 all, [](const Iterated&i) { return i.height > 1 && i.left_at_top < 0.5; });
  return assessed(
      "2.4-flattening", "Section 2.4",
      "Measurements that iterate over the same states flatten the information surface: after 100 of them where the "
      "information of actions was greatest that surface, over all directions, is flatter (its largest less its smallest "
      "gain), in at least 95 % of random layouts of landmarks on a plane",
      {.rule = Rule::frequency,
       .measured =
           {"of {} layouts flatter in {}; largest less smallest gain {:.2f} of what it was, the gain at "
            "that place {:.3f} (medians)",
            drawn, flatter, median_of(each(all, &Iterated::height)),
            median_of(each(all, &Iterated::left_at_top))},
       .number = exactly("layouts of 100 in which the surface is flatter", static_cast<double>(flatter)),
       .why = "the gain at that place falls to less than half; over all directions the surface gets steeper",
       .runs = drawn},
      happens_in(0.95, flatter, drawn), in_truth(happens_in(0.95, steeper_top_lower, drawn)));
}

Claim pushed_away(const std::vector<Iterated>& all) {
  const auto away = std::ranges::count_if(all, [](const Iterated& i) { return i.moved_m > 0.25; });
  return assessed(
      "2.4-pushed-away", "Section 2.4",
      "Measurements that iterate over the same states push the robot away: after 100 of them where the information of "
      "actions was greatest another place, 0.25 m away or more, promises the most, in at least 95 % of random layouts of "
      "landmarks on a plane",
      {.rule = Rule::frequency,
       .measured = {"in {} of {} layouts; distance {:.2f} m (median)", away, drawn,
                    median_of(each(all, &Iterated::moved_m))},
       .number = exactly("layouts of 100 in which the camera is pushed away", static_cast<double>(away)),
       .runs = drawn},
      happens_in(0.95, away, drawn));
}

int most_of(const std::vector<double>& gains) {
  return static_cast<int>(std::ranges::max_element(gains) - gains.begin());
}

/// Chosen of gains that are evaluated one a frame, in that order; and with the belief before all of these frames.
struct Chosen {
  int in_turn = 0, at_once = 0;
};

Chosen chosen(const Plane& start, const std::vector<int>& order) {
  Plane plane = start;
  std::vector<double> in_turn(sets_of_actions), at_once;
  for (int i = 0; i < sets_of_actions; ++i)
    at_once.push_back(plane.gain_at(way(360.0 * i / sets_of_actions)));
  for (const int i : order) {
    plane.measure_at({0, 0});
    in_turn[static_cast<std::size_t>(i)] = plane.gain_at(way(360.0 * i / sets_of_actions));
  }
  return {most_of(in_turn), most_of(at_once)};
}

/// More often chosen than if all were evaluated at once, -1, 0 or 1 of a layout: the first action of the fixed order.
struct Bias {
  double fixed = 0, random = 0;
};

Bias bias_of(std::uint64_t seed) {
  RandomStream random(seed, "section-6.4.3");
  Plane plane = drawn_landmarks(random);
  measure_often(plane, 10, random);
  std::vector<int> order(sets_of_actions);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::rotate(order, order.begin() + random.below(sets_of_actions));  // any action may be the first
  const int first = order.front();
  const auto bias = [&](const Chosen& one) {
    return static_cast<double>(one.in_turn == first) - static_cast<double>(one.at_once == first);
  };
  const double fixed = bias(chosen(plane, order));
  for (int i = sets_of_actions - 1; i > 0; --i)
    std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(random.below(i + 1))]);
  return {fixed, bias(chosen(plane, order))};
}

Claim random_order(int seeds) {
  const std::vector<Bias> all = over_seeds(seeds, bias_of);
  const Interval fixed = bootstrap_mean(each(all, &Bias::fixed)),
                 random = bootstrap_mean(each(all, &Bias::random));
  return assessed(
      "6.4.3-order", "Section 6.4.3",
      "The order in which actions are evaluated, one a frame, biases the choice, and a random order evades that: by a "
      "fixed order the action that comes first is chosen by 0.03 of the choices more or less often than if all were "
      "evaluated at once, by a random order it is not",
      {.rule = Rule::equality,
       .measured = {"share of choices, more than at once: fixed order {}, random order {}", text(fixed),
                    text(random)},
       .number = ClaimNumber{"share by which the first action of a fixed order is chosen more often", fixed},
       .why = "it is within 0.03 by either order",
       .seeds = seeds},
      !agrees(fixed, 0, 0.03) && agrees(random, 0, 0.03),
      in_truth(agrees(fixed, 0, 0.03) && agrees(random, 0, 0.03)));
}

/// H' R^-1 H of the measurements at a place. S in place of R has the same null space and no sum that means anything.
MatrixXd information_at(const Plane& plane, const Vector2d& place, bool with_S) {
  const ImaginedStep step = plane.step_to(place);
  const auto rows = static_cast<Index>(step.measurements.size());
  const MatrixXd P = plane.belief.dense_covariance();
  MatrixXd H = MatrixXd::Zero(rows, P.cols());
  for (Index i = 0; i < rows; ++i) {
    const PredictedMeasurement& one = step.measurements[static_cast<std::size_t>(i)];
    H.block(i, 0, 1, 3) = one.Hv;
    H.block(i, plane.belief.offset(one.block), 1, 2) = one.Hl;
  }
  MatrixXd S = sigma_bearing * sigma_bearing * MatrixXd::Identity(rows, rows);
  if (with_S) S += H * P * H.transpose();
  return H.transpose() * S.inverse() * H;
}

int zero_eigenvalues(const MatrixXd& F) {
  const VectorXd all = Eigen::SelfAdjointEigenSolver<MatrixXd>(F).eigenvalues();
  return static_cast<int>((all.array() < 1e-10 * all.maxCoeff()).count());
}

Claim shows_unobservable() {
  Extremes one, of_sum;
  RandomStream random(11, "section-6.1.2");
  for (int i = 0; i < drawn; ++i) {
    const Plane plane = drawn_landmarks(random);
    MatrixXd sum = MatrixXd::Zero(9, 9);
    for (int k = 0; k < 20; ++k) {
      const double x = random.uniform(-0.5, 0.5), y = random.uniform(-0.5, 0.5);
      sum += information_at(plane, {x, y}, false);
    }
    one.take(zero_eigenvalues(information_at(plane, {0, 0}, true)));
    of_sum.take(zero_eigenvalues(sum));
  }
  return assessed(
      "6.8-eigenvalues", "below (6.8)",
      "Zero eigenvalues of one iteration's H' S^-1 H show which combinations of states are unobservable: it has as many "
      "as the camera's motion leaves unobservable",
      {.rule = Rule::dimension,
       .measured =
           {"of {} layouts with three landmarks: {:.0f} to {:.0f} zero eigenvalues of nine in one iteration, "
            "{:.0f} to {:.0f} of the sum over 20 places (camera and map shifted together)",
            drawn, one.least, one.most, of_sum.least, of_sum.most},
       .number = exactly("zero eigenvalues of one iteration, where two are unobservable", one.most),
       .why =
           "of the sum over iterations from several places. One iteration's also counts what the next place shows",
       .runs = drawn},
      one.least == 2 && one.most == 2, on_condition(of_sum.least == 2 && of_sum.most == 2 && one.least > 2));
}

}  // namespace

std::vector<Claim> surface_claims(int seeds) {
  const std::vector<Iterated> iterated = iterate_measurements();
  return {shows_unobservable(), flattened(iterated), pushed_away(iterated), random_order(seeds)};
}

}  // namespace incognita::section_6_1_plane
