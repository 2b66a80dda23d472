// Information gain against entropy where actions are evaluated one after the other, each with the belief of its
// own frame: Section 6.2.
//
// Experiment: the camera of section_6_1.hpp in random layouts, after 0, 10 and 100 measurements from around. Of
// seven actions, 0.5 m in directions evenly apart, one is evaluated in each frame, in random order, while the
// camera stands and measures in every frame. Chosen is the one with the largest gain of its frame, or the one
// after which entropy is the least. What a choice loses is how much less information it gains than the best
// action, all with the belief after the last frame. (6.9) is tested with all actions evaluated at once, against beliefs
// that moved and measured.
#include <numeric>

#include "experiments/common.hpp"
#include "experiments/section_6_1.hpp"

namespace incognita::section_6_1_plane {
namespace {

constexpr int actions = 7;

Vector2d action(int i) { return way(360.0 * i / actions); }

/// Of the belief after a step, without its measurements; but for a constant.
double entropy_after(const Plane& plane, const ImaginedStep& step) {
  MatrixXd P = plane.belief.dense_covariance();
  P.topLeftCorner(3, 3) += step.N;
  return P.llt().matrixLLT().diagonal().array().log().sum();
}

struct Lost {
  double by_gain = 0, by_entropy = 0;  ///< nats
};

Lost lost(int measured_before, std::uint64_t seed) {
  RandomStream random(seed, "section-6.2");
  Plane plane = drawn_landmarks(random);
  measure_often(plane, measured_before, random);
  std::vector<int> order(actions);
  std::iota(order.begin(), order.end(), 0);
  for (int i = actions - 1; i > 0; --i)
    std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(random.below(i + 1))]);
  int by_gain = 0, by_entropy = 0;
  double most = -1, least = std::numeric_limits<double>::infinity();
  for (const int i : order) {
    plane.measure_at({0, 0});
    const ImaginedStep step = plane.step_to(action(i));
    const double gain = plane.gain_of(step).of_state(), entropy = entropy_after(plane, step) - gain;
    if (gain > most) most = gain, by_gain = i;
    if (entropy < least) least = entropy, by_entropy = i;
  }
  std::vector<double> gains;
  for (int i = 0; i < actions; ++i) gains.push_back(plane.gain_at(action(i)));
  const auto missing = [&](int i) { return std::ranges::max(gains) - gains[static_cast<std::size_t>(i)]; };
  return {missing(by_gain), missing(by_entropy)};
}

Claim mutual_information_or_entropy(int seeds) {
  Cases all;
  Interval last;
  for (const int before : {0, 10, 100}) {
    const std::vector<Lost> layouts =
        over_seeds(seeds, [&](std::uint64_t seed) { return lost(before, seed); });
    const auto by_gain = each(layouts, &Lost::by_gain), by_entropy = each(layouts, &Lost::by_entropy);
    last = bootstrap_mean(less(by_entropy, by_gain));
    all.add({{"after {} measurements {:.4f} and {:.4f}, difference {}", before, mean_of(by_entropy).value,
              mean_of(by_gain).value, text(last)},
             is_above(last, 0)});
  }
  return assessed(
      "6.1-mutual-or-entropy", "Section 6.2",
      "Where actions are evaluated in different frames mutual information is a better choice than "
      "entropy only: the chosen action gains more",
      {.rule = Rule::superiority,
       .measured = {"nats less than the best action, by entropy and by mutual information: {}", all.text()},
       .number = ClaimNumber{"lost by entropy, less what is lost by mutual information, after 100 "
                             "measurements",
                             last, "nats"},
       .seeds = seeds},
      all.hold());
}

/// Of the belief, but for a constant.
double entropy_of(const Plane& plane) {
  return plane.belief.dense_covariance().llt().matrixLLT().diagonal().array().log().sum();
}

/// How much an action takes from the entropy of the belief: after its motion, less after its measurements.
double entropy_taken(Plane plane, int i) {
  const ImaginedStep step = plane.step_to(action(i));
  const double before = entropy_after(plane, step);
  plane.measure_at(action(i));
  return before - entropy_of(plane);
}

/// (6.9): the action with the largest gain, by log-determinants of beliefs that have moved and measured.
Claim most_informative_action() {
  constexpr int layouts = 100;
  int right = 0, cases = 0;
  double apart = 0, least_ahead = std::numeric_limits<double>::infinity();
  RandomStream random(9, "section-6.2");
  for (const int before : {0, 10, 100})
    for (int k = 0; k < layouts; ++k, ++cases) {
      Plane plane = drawn_landmarks(random);
      measure_often(plane, before, random);
      std::vector<double> gains, taken;
      for (int i = 0; i < actions; ++i) {
        gains.push_back(plane.gain_at(action(i)));
        taken.push_back(entropy_taken(plane, i));
        apart = std::max(apart, std::abs(gains.back() - taken.back()) / (1 + taken.back()));
      }
      const auto best = std::ranges::max_element(gains) - gains.begin();
      right += best == std::ranges::max_element(taken) - taken.begin();
      least_ahead = std::min(least_ahead, taken[static_cast<std::size_t>(best)] - std::ranges::min(taken));
    }
  return assessed(
      "6.9-most-informative", "(6.9)",
      "The action with the largest mutual information of state and measurements, for a camera on a plane "
      "with three landmarks and seven actions, is the one whose measurements reduce the entropy of the "
      "belief most (gain and reduction equal to 1e-9)",
      {.printed = "J = max over u of I(X; Z^k)",
       .measured =
           {"in {} of {} layouts, each after 0, 10 or 100 measurements; largest difference of the gain from "
            "log|P| after motion less after update: {}; the chosen action reduces the entropy by at least {:.3f} nats more than the worst",
            right, cases, below(apart), least_ahead},
       .number = exactly(fmt::format("layouts in which it is so, of {}", cases), right),
       .runs = cases},
      right == cases && apart < 1e-9);
}

}  // namespace

std::vector<Claim> choice_claims(int seeds) {
  return {most_informative_action(), mutual_information_or_entropy(seeds)};
}

}  // namespace incognita::section_6_1_plane
