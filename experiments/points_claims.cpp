// What Chapters 6 and 7 say of cameras and vehicles among points, besides which strategy leaves the least entropy:
// identities by nearest neighbor, and which motions are chosen.
//
// Experiment: scenarios/free-camera.toml, 35 s, and scenarios/terrain.toml, 35 s from the middle of the room, 40 rooms
// each. Identities are given there; here landmarks are also matched by nearest neighbor with the thesis' chi-squared
// tests, in 100 rooms (anchors keep their identity), gaze by (i). Which motions are chosen is seen with gaze by (iii),
// the thesis' proposal. The plan, written before the runs: "guarantee correct matching" means that no match is wrong;
// motions along the line of sight are avoided if they are chosen less often than a blind choice of the same set would.
// After a first run, with 40 rooms, gaze by (i) and a vehicle that starts before a wall, the number of rooms, that gaze
// and that start were changed, and a reason (fewer than one in twenty) was added.
#include "experiments/common.hpp"
#include "experiments/comparisons.hpp"
#include "experiments/exploring_claims.hpp"
#include "experiments/paired_factor.hpp"

namespace incognita::exploring {
namespace {

const std::string among_points =
    "in rooms of 33 points (inverse depths from the first view on; start drawn with 2 cm and 0.02 rad)";
const std::string for_a_vehicle =
    "in rooms of 31 points (inverse depths from the first view on, identities given; start in the middle)";

double share_wrong(const Run& run) {
  const auto wrong = static_cast<double>(run.matches_wrong);
  return wrong / (wrong + static_cast<double>(run.matches_right));
}

Claim correct_matching(const Runs& nearest) {
  std::int64_t wrong = 0, all = 0;
  for (const Run& run : nearest) wrong += run.matches_wrong, all += run.matches_wrong + run.matches_right;
  const auto rooms = std::ranges::count_if(nearest, [](const Run& run) { return run.matches_wrong > 0; });
  const Interval share = bootstrap_mean(each(nearest, share_wrong));
  return assessed(
      "6.3-nearest-right", "Section 6.3.1",
      "Nearest neighbor chi-squared tests guarantee correct matching: no match is wrong, identities not given, gaze (i) "
      "constant rate, " +
          among_points,
      {.rule = Rule::example,
       .measured = {"{} of {} matches wrong, in {} of {} rooms; share of a room's matches {}", wrong, all,
                    rooms, nearest.size(), text(share)},
       .number = ClaimNumber{"share of wrong matches", share},
       .why = "fewer than one in twenty are",
       .seeds = nearest.size()},
      wrong == 0, in_truth(is_below(share, 0.05)));
}

Claim as_good_as_identities(const Runs& given, const Runs& nearest) {
  const Interval error = times(given, nearest, &Run::position_rms_m);
  return assessed(
      "6.3-nearest-errors", "Section 6.3.1",
      "With landmarks matched by nearest neighbor the camera is localized as well as with identities "
      "that are given: position errors within a factor of 1.25, gaze (i) constant rate, " +
          among_points,
      {.rule = Rule::equality,
       .measured = {"error over that with identities: {}; diverged {} and {} of {}", text(error),
                    diverged_of(nearest), diverged_of(given), nearest.size()},
       .number = ClaimNumber{"position error over that with given identities", error},
       .seeds = nearest.size()},
      as_good(error));
}

/// Of the moves that were chosen, not to stay.
double share_along(const Run& run) { return 1 - share_across(run); }

Claim well_posed(const Runs& runs) {
  const std::vector<double> of_moves = less(each(runs, share_along), std::vector<double>(runs.size(), 0));
  const Interval share = bootstrap_mean(of_moves);
  return assessed(
      "6.3-well-posed", "Section 6.3.1",
      "Moving by mutual information a free camera avoids moves along its line of sight, which show no depth: forward "
      "and backward are fewer than their third of all moves, identities given, gaze (iii) Fisher information, " +
          among_points,
      {.rule = Rule::superiority,
       .measured = {"share of a run's moves {}", text(share)},
       .number = ClaimNumber{"share of moves along the line of sight", share},
       .seeds = of_moves.size()},
      is_below(share, 1.0 / 3));
}

double share_straight(const Run& run) {
  const auto straight = std::ranges::count_if(
      run.decisions, [](const Decision& d) { return d.action == "slower" || d.action == "faster"; });
  return static_cast<double>(straight) / static_cast<double>(run.decisions.size());
}

Claim hindering_avoided(const Runs& runs) {
  const Interval share = bootstrap_mean(each(runs, share_straight));
  return assessed(
      "7.2-hinder", "Section 7.2",
      "Actions that hinder observability were avoided: a vehicle whose camera looks ahead accelerates straight along "
      "the line of sight in less than two of seven decisions, their share of Table 6.1, " +
          for_a_vehicle,
      {.rule = Rule::superiority,
       .measured = {"share of a run's decisions {}", text(share)},
       .number = ClaimNumber{"share of accelerations along the line of sight", share},
       .why = "they are chosen more often than that",
       .seeds = runs.size()},
      is_below(share, 2.0 / 7), in_truth(is_above(share, 2.0 / 7)));
}

double returns_per_minute(const Run& run) { return 60 * returns(run) / run.instants.back().t_s; }

Claim by_platform(const Runs& camera, const Runs& vehicle) {
  const Interval more_returns = more_than(vehicle, camera, returns_per_minute),
                 more_backward = more_than(camera, vehicle, share_backwards);
  const std::vector<Comparison> both{
      claimed_above("returns", {"returns a minute, camera less vehicle", more_returns}, 0),
      claimed_above("backward", {"share of the path driven backward, vehicle less camera", more_backward},
                    0)};
  return assessed(
      "6.4-platform", "end of Section 6.4.2",
      fmt::format(
          "The same strategy chooses short loops for a free camera and backward motion for a vehicle: more "
          "landmarks a minute come back after {} s or more out of view to the camera, and the vehicle drives "
          "a larger share of its path backward; the camera, gaze (iii), {}, the vehicle {}",
          away_s, among_points, for_a_vehicle),
      {.rule = Rule::superiority,
       .measured =
           {"camera less vehicle: {} returns a minute ({} and {}); vehicle less camera: {} of the path "
            "backward ({} and {})",
            text(more_returns), decimals(mean_of(each(camera, returns_per_minute)).value, 1),
            decimals(mean_of(each(vehicle, returns_per_minute)).value, 1), text(more_backward),
            decimals(mean_of(each(vehicle, share_backwards)).value, 2),
            decimals(mean_of(each(camera, share_backwards)).value, 2)},
       .number = deciding(both),
       .why = "more landmarks come back to the vehicle",
       .seeds = camera.size()},
      all_shown(both), in_truth(is_below(more_returns, 0)));
}

LedgerEntry run_points_claims(const ExperimentSettings& all_seeds) {
  const ExperimentSettings pairs = half_of(all_seeds);
  ExperimentSettings settings = all_seeds;
  settings.seeds = (settings.seeds + 4) / 5;
  const auto turning = [&](const std::string& name, Sets sets, const ExperimentSettings& of) {
    sets.push_back("decision.gaze=constant-rate");
    return runs_of("free-camera", {name, sets}, of);
  };
  const Runs given = turning("identities given", {}, pairs),
             nearest = turning("nearest neighbor", {"association.method=nearest"}, pairs),
             camera = runs_of("free-camera", by_gaze()[2], settings),
             vehicle = runs_of("terrain", {"vehicle", {"run.duration_s=35", "start.positions_m=[[0, 0, 0]]"}},
                               settings);
  return entry_of(points_claims, settings,
                  {correct_matching(nearest), as_good_as_identities(given, nearest), well_posed(camera),
                   hindering_avoided(vehicle), by_platform(camera, vehicle)});
}

}  // namespace
}  // namespace incognita::exploring

const incognita::Experiment incognita::points_claims{
    "points", "Among points: identities and chosen motions", {}, exploring::run_points_claims, true};
