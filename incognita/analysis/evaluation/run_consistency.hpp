// Whether the NIS and the NEES of a single run are those of a consistent filter (Bar-Shalom et al. 2001,
// ch. 5.4).
#pragma once

#include <cstdint>
#include <optional>

#include "incognita/analysis/evaluation/statistics.hpp"

namespace incognita {

enum class Consistency { consistent, overconfident, conservative, unknown };
const char* name(Consistency verdict);

/// The mean over a run of a normalized square that is divided by its degrees of freedom, so that 1 is right.
struct MeanNormalizedSquare {
  double mean = 0;
  Interval band;  ///< where the mean of a consistent filter belongs
  Consistency verdict() const;
};

/// Fewer samples say nothing.
inline constexpr std::int64_t fewest_samples = 10;

/// Mean NEES over `samples` frames, each of `degrees_of_freedom`. The errors of a run depend on each other
/// for as long as it lasts (where no anchor holds the frame, the error of the start stays), so that all its
/// frames count as one sample: the band holds 99 % of chi-square with these degrees of freedom. Of a team
/// those of its robots together. Nothing for fewer than fewest_samples.
std::optional<MeanNormalizedSquare> mean_nees_of_run(double mean, std::int64_t samples,
                                                     int degrees_of_freedom);

/// Mean NIS over `samples` updates. Innovations of a consistent filter are white, so that each update counts;
/// but models are approximations, and a band for some thousand samples would refuse them all. So the band is
/// 0.5 to 2, a sigma that is wrong by a factor of 1.4, or 99 % of chi-square with all degrees of freedom
/// where that is wider.
std::optional<MeanNormalizedSquare> mean_nis_of_run(double mean, std::int64_t samples,
                                                    double degrees_of_freedom_in_all);

}  // namespace incognita
