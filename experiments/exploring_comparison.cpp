#include "experiments/exploring_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "experiments/evidence.hpp"
#include "experiments/seeds.hpp"
#include "incognita/analysis/median.hpp"
#include "incognita/math/quaternion.hpp"

namespace incognita::exploring {
namespace {

/// Scores in frames that choose nothing would only take time.
Sets sets_of(const Strategy& strategy) {
  Sets sets = strategy.sets;
  const bool told = std::any_of(sets.begin(), sets.end(),
                                [](const std::string& s) { return s.starts_with("decision.schedule"); });
  if (!told) sets.push_back("decision.schedule=at-decisions");
  return sets;
}

/// Of the way that it went the share that it went backwards.
double share_backwards(const Run& run) {
  double back = 0, all = 0;
  for (std::size_t i = 1; i < run.instants.size(); ++i) {
    const StampedPose &from = run.instants[i - 1].truth, &to = run.instants[i].truth;
    const Eigen::Vector3d ahead = rotation_matrix<double>(from.orientation).col(2);
    const double way = (to.position - from.position).dot(ahead);
    back += std::max(0.0, -way);
    all += std::abs(way);
  }
  return all > 0 ? back / all : std::nan("");
}

/// Of those that are numbers, with its interval.
Interval median_known(std::vector<double> numbers) {
  std::erase_if(numbers, [](double x) { return !std::isfinite(x); });
  return median_interval(std::move(numbers));
}

std::ptrdiff_t lost_of(const Runs& runs) {
  return std::count_if(runs.begin(), runs.end(), [](const Run& r) { return r.lost; });
}

std::ptrdiff_t astray_of(const Runs& runs) { return std::count_if(runs.begin(), runs.end(), went_astray); }

/// Not a number of a run that went astray: the entropy of one that was lost is that of its last decision, by
/// so much too high, and one that is off by so much believes to know what it does not.
double entropy_if_found(const Run& run) { return went_astray(run) ? std::nan("") : final_entropy(run); }

double typically_off_m(const Runs& runs) {
  return median_of_known(each(runs, [](const Run& r) { return r.position_rms_m; }));
}

}  // namespace

Runs runs_of(const std::string& scenario, const Strategy& strategy, const ExperimentSettings& settings,
             std::uint64_t first) {
  if (settings.tell) settings.tell(fmt::format("  {}, {}: {} runs", scenario, strategy.name, settings.seeds));
  return over_seeds(settings.seeds, [&](std::uint64_t seed) {
    return explore(scenario, sets_of(strategy), first - 1 + seed);
  });
}

bool went_astray(const Run& run) { return run.lost || !(run.position_rms_m <= 0.5); }

std::vector<double> less(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isfinite(a[i] - b[i])) difference.push_back(a[i] - b[i]);
  return difference;
}

double median_of_known(std::vector<double> numbers) { return median_known(std::move(numbers)).value; }

std::string in_numbers(const std::string& name, const Runs& runs) {
  // A run that never located so many did so after all others
  const auto located_14 = [](const Run& r) {
    return r.located_at_s(14).value_or(std::numeric_limits<double>::infinity());
  };
  const auto located = [](const Run& r) { return static_cast<double>(r.located_t_s.size()); };
  constexpr double overconfident = 3;
  return fmt::format(
      "{}: entropy {}, off {} m (median), NEES {:.2f} (median; above {} in {}), {} located, {} % seen, 14th "
      "after {} s (median), {} lost",
      name, text(bootstrap_mean(each(runs, final_entropy))),
      text(median_known(each(runs, [](const Run& r) { return r.position_rms_m; }))),
      median_of_known(each(runs, [](const Run& r) { return r.nees; })), overconfident,
      std::count_if(runs.begin(), runs.end(), [](const Run& r) { return r.nees > overconfident; }),
      text(bootstrap_mean(each(runs, located))),
      text(bootstrap_mean(each(runs, [](const Run& r) { return 100 * r.coverage; }))),
      text(median_interval(each(runs, located_14))), lost_of(runs));
}

double share_across(const Run& run) {
  double across = 0, along = 0;
  for (const Decision& d : run.decisions) {
    if (d.action == "go_forward" || d.action == "go_backwards")
      ++along;
    else if (d.action != "stay")
      ++across;
  }
  return across / (across + along);
}

Claim backs_away(const std::string& id, const std::string& place, const std::string& printed,
                 const std::string& start, const Runs& runs, const std::string& why) {
  const std::vector<double> shares = each(runs, share_backwards);
  std::vector<double> beyond_half;
  for (const double share : shares)
    if (std::isfinite(share)) beyond_half.push_back(share - 0.5);
  const Interval more = bootstrap_mean(beyond_half, judged_at);
  int slower = 0, faster = 0;
  for (const Run& run : runs)
    for (const Decision& d : run.decisions) {
      slower += d.action.starts_with("slower");
      faster += d.action.starts_with("faster");
    }
  return judged(
      {.id = id,
       .place = place,
       .statement = "The vehicle explores by repeatedly choosing a negative linear acceleration: of "
                    "the way that it goes more than half is backwards, starting " +
                    start,
       .printed = printed,
       .measured = fmt::format("share backwards less a half: {} (99.9 %); {} decisions for slower, "
                               "{} for faster",
                               text(more), slower, faster),
       .why = why,
       .runs = static_cast<int>(runs.size())},
      more.low > 0);
}

Claim beats(const std::string& id, const std::string& place, const std::string& statement,
            const std::string& what, const Runs& ours, const Runs& theirs, const std::string& why) {
  const std::vector<double> differences = less(each(ours, final_entropy), each(theirs, final_entropy));
  const Interval gap = bootstrap_mean(differences, judged_at);
  const auto better = std::count_if(differences.begin(), differences.end(), [](double d) { return d < 0; });
  const std::size_t left_out = ours.size() - differences.size();
  const auto found = less(each(ours, entropy_if_found), each(theirs, entropy_if_found));
  const Interval gap_if_found = bootstrap_mean(found, judged_at);
  const bool any_astray = astray_of(ours) + astray_of(theirs) > 0;
  Claim claim{
      id,
      place,
      statement,
      "",
      fmt::format(
          "entropy less that of {}: {} nats (99.9 %), lower in {} of {} rooms{}; astray {} and {}{}, "
          "off {:.3f} and {:.3f} m (median)",
          what, text(gap), better, differences.size(),
          left_out > 0 ? fmt::format(", {} with nothing to compare", left_out) : "", astray_of(ours),
          astray_of(theirs),
          any_astray ? fmt::format(", neither in {}: there {} nats", found.size(), text(gap_if_found)) : "",
          typically_off_m(ours), typically_off_m(theirs)),
      Verdict::does_not_hold,
      why,
      static_cast<int>(differences.size())};
  return judged(claim, gap.high < 0 && gap_if_found.high < 0);
}

}  // namespace incognita::exploring
