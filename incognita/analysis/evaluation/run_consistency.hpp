// Consistency of a single run by its NIS and NEES (Bar-Shalom et al. 2001, ch. 5.4).
#pragma once

#include <cstdint>
#include <optional>

#include "incognita/analysis/evaluation/statistics.hpp"

namespace incognita {

enum class Consistency { consistent, overconfident, conservative, unknown };
const char* name(Consistency verdict);

/// Mean over a run of a normalized square divided by its degrees of freedom: 1 if consistent.
struct MeanNormalizedSquare {
  double mean = 0;
  Interval band;  ///< acceptance region of a consistent filter
  Consistency verdict() const;
};

/// Minimum number of samples for a verdict.
inline constexpr std::int64_t fewest_samples = 10;

/// Mean NEES over `samples` frames, each of `degrees_of_freedom`. The errors of a run are correlated over its
/// whole duration (without an anchor the initial error persists), so all frames count as one sample: the band
/// holds 99 % of chi-square with these degrees of freedom. For a team, the degrees of freedom of all robots
/// together. Empty for fewer than fewest_samples.
std::optional<MeanNormalizedSquare> mean_nees_of_run(double mean, std::int64_t samples,
                                                     int degrees_of_freedom);

/// Mean NIS over `samples` updates. Innovations of a consistent filter are white, so every update counts; but models
/// are approximate, and a band for thousands of samples would reject them all. The band is therefore 0.5 to 2 (a
/// sigma wrong by a factor of 1.4), or 99 % of chi-square with all degrees of freedom if that is wider.
std::optional<MeanNormalizedSquare> mean_nis_of_run(double mean, std::int64_t samples,
                                                    double degrees_of_freedom_in_all);

}  // namespace incognita
