// Example 5.4: the path of (5.28) against others, in the same rooms.
#include <functional>
#include <utility>

#include "experiments/common.hpp"
#include "experiments/example_5_4.hpp"
#include "experiments/paired_factor.hpp"

namespace incognita::swinging_camera {
namespace {

using Runs = std::vector<Summary>;

/// A position and a heading at each time.
Path sampled(const std::function<std::pair<Vector3d, double>(double)>& pose) {
  PathSamples samples;
  for (int k = 0; k <= 840; ++k) {
    const double t = k / 20.0;
    const auto [position, heading] = pose(t);
    samples.t.push_back(t);
    samples.position.push_back(position);
    samples.heading.push_back(heading);
  }
  return through(samples);
}

enum class Facing { inward, outward };

/// On the circle of (5.28), at the angle that is p there.
Path on_circle(const std::function<double(double)>& angle, Facing facing = Facing::inward) {
  return sampled([=](double t) {
    const double p = angle(t);
    return std::pair(Vector3d(circle.radius_m * Vector3d(-std::cos(p), std::sin(p), 0)),
                     facing == Facing::inward ? -p : pi - p);
  });
}

const double A = circle.amplitude_rad;

double back_and_forth(double t) { return A * (std::sin(2 * t) - 2 * t / pi); }
double steadily(double t) { return -2 * A * t / pi; }
/// Around in the same direction at a varying speed, never backward.
double surging(double t) { return -2 * A / pi * (t - 0.475 * std::sin(2 * t)); }
double in_place(double t) { return A * std::sin(2 * t); }

Runs along(const std::function<double(double)>& angle, int seeds, Facing facing = Facing::inward) {
  return runs({.path = on_circle(angle, facing)}, seeds);
}

Runs first(const Runs& all, int count) {
  return {all.begin(), all.begin() + std::min<std::ptrdiff_t>(count, std::ssize(all))};
}

/// By how much b's is larger than a's in the same rooms.
Interval larger(const Runs& b, const Runs& a, double Summary::*what) {
  return factor(each(b, what), each(a, what));
}

std::string numbers(const Runs& runs) {
  return fmt::format("{:.3f} m rms (largest sigma {:.3f} m, NEES {:.1f}, {:.1f} points mapped)",
                     median(runs, &Summary::rms_error_m), median(runs, &Summary::most_sigma_m),
                     median(runs, &Summary::pose_nees), mean_of(each(runs, &Summary::mapped)).value);
}

Claim short_loops(const Compared& c) {
  const Interval error = larger(c.surges, c.example, &Summary::rms_error_m),
                 sigma = larger(c.surges, c.example, &Summary::most_sigma_m);
  return assessed(
      "5.4-short-loops", "Section 5.2.2, Figure 5.14",
      "Closing short loops is crucial to reduce the uncertainty: around the same circle in the same time at "
      "a varying speed, but never backward, the largest sigma is larger and the error of the estimate twice "
      "as large or more",
      {.rule = Rule::superiority,
       .measured = {"back and forth {}; never backward {}; factors {} of the error and {} of sigma",
                    numbers(c.example), numbers(c.surges), text(error), text(sigma)},
       .number = ClaimNumber{"error along the path that is never backward over that of (5.28)", error},
       .seeds = c.surges.size()},
      is_above(error, 2) && is_above(sigma, 1));
}

Claim varied_motion(const Compared& c) {
  const Interval alone = larger(c.steady, c.surges, &Summary::rms_error_m),
                 returning = larger(c.steady, c.example, &Summary::rms_error_m);
  return assessed("5.4-varied", "head of Section 5.2.2, after [118]",
                  "Motion that is not constant lets such systems estimate well: around the same circle in "
                  "the same time a camera at constant speed has a larger error than one at varying speed",
                  {.rule = Rule::superiority,
                   .measured = {"constant speed {}; varying speed {}: factor {}; against back and forth {}",
                                numbers(c.steady), numbers(c.surges), text(alone), text(returning)},
                   .number = ClaimNumber{"error at constant speed over that at varying speed", alone},
                   .why = "if it returns, back and forth; a varying speed alone is not enough",
                   .seeds = c.steady.size()},
                  is_above(alone, 1), on_condition(is_above(returning, 1)));
}

Claim most_stable(const Compared& c) {
  Cases others;
  int worse = 0;
  Answer most_are_worse = Answer::undecided;
  Interval next{std::numeric_limits<double>::infinity(), 0, 0};  // the best of the worse
  int decided = 0;
  using Other = std::pair<const char*, const Runs&>;
  for (const auto& [name, runs] :
       {Other{"never backward", c.surges}, Other{"constant speed", c.steady},
        Other{"facing outward", c.outward}, Other{"swinging in place", c.swings}}) {
    const Interval error = larger(runs, c.example, &Summary::rms_error_m);
    const Answer is_worse = is_above(error, 1);
    worse += is_worse == Answer::shown, decided += is_worse != Answer::undecided;
    if (is_worse == Answer::shown && error.value < next.value) next = error;
    others.add({{"{} {} (largest sigma {:.3f} m, {:.0f} points)", name, text(error, "times"),
                 median(runs, &Summary::most_sigma_m), mean_of(each(runs, &Summary::mapped)).value}});
  }
  if (worse > 2 || decided == 4) most_are_worse = worse > 2;
  return assessed("5.4-most-stable", "below (5.27)",
                  "(5.28) is one of the most stable paths: the estimate is nearer to the truth along it than "
                  "along more than half of the four others tried",
                  {.rule = Rule::superiority,
                   .measured = {"error of the others over that along (5.28): {}", others.text()},
                   .number = ClaimNumber{"error along the next path over that along (5.28)", next},
                   .seeds = c.steady.size()},
                  most_are_worse);
}

/// Of the points that both runs of a room have mapped: how much larger the second's sigma is, by mean
/// logarithms of each room; near the first optical axis, or all.
std::vector<double> larger_by(const std::vector<Course>& a, const std::vector<Course>& b,
                              double most_angle_rad) {
  std::vector<double> rooms;
  for (std::size_t i = 0; i < a.size(); ++i) {
    double sum = 0;
    int count = 0;
    for (const MappedPoint& p : a[i].map)
      for (const MappedPoint& q : b[i].map) {
        const Vector3d from_start = p.truth - Vector3d(-circle.radius_m, 0, 0);
        if (p.truth != q.truth || std::acos(from_start.normalized().x()) > most_angle_rad) continue;
        sum += std::log(q.covariance.trace() / p.covariance.trace()) / 2, ++count;
      }
    if (count > 0) rooms.push_back(sum / count);
  }
  return rooms;
}

Claim sideways(int seeds) {
  const auto swinging = [&](const Vector3d& direction) {
    const Vector3d start(-circle.radius_m, 0, 0);
    const Setup s{.path = sampled([=](double t) {
                    return std::pair(Vector3d(start + 0.4 * std::sin(2 * t) * direction), 0.0);
                  }),
                  .duration_s = 10};
    return over_seeds(seeds, [&](std::uint64_t seed) { return run(s, seed); });
  };
  const auto across = swinging(Vector3d::UnitY()), ahead = swinging(Vector3d::UnitX());
  const Interval near = bootstrap_mean(larger_by(across, ahead, radians(20))),
                 all = bootstrap_mean(larger_by(across, ahead, pi));
  return assessed(
      "5.4-sideways", "head of Section 5.2.2",
      "Motion across the camera's axis reduces the uncertainty more than motion along it: after 10 s of "
      "swinging by 0.4 m sigmas of the same points are larger along than across",
      {.rule = Rule::superiority,
       .measured = {"along against across: all points {}, those within 20 degrees of the axis {}",
                    text(exponential(all), "times"), text(exponential(near), "times")},
       .number =
           ClaimNumber{"sigma of all points by motion along the axis over that across", exponential(all)},
       .why = "of points within 20 degrees of the axis",
       .seeds = seeds},
      is_above(all, 0), on_condition(is_above(near, 0)));
}

}  // namespace

Compared compare_paths(const ExperimentSettings& settings, const Runs& example) {
  const int seeds = fewer(settings);
  return {first(example, seeds), along(steadily, seeds), along(surging, seeds), along(in_place, seeds),
          along(back_and_forth, seeds, Facing::outward)};
}

std::vector<Claim> path_claims(const ExperimentSettings& settings, const Compared& compared) {
  return {short_loops(compared), varied_motion(compared), most_stable(compared), sideways(settings.seeds)};
}

}  // namespace incognita::swinging_camera
