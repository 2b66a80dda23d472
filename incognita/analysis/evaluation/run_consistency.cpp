#include "incognita/analysis/evaluation/run_consistency.hpp"

#include <algorithm>
#include <cmath>

namespace incognita {
namespace {

constexpr double band_confidence = 0.99;
constexpr double lowest_nis = 0.5, highest_nis = 2;

}  // namespace

const char* name(Consistency verdict) {
  switch (verdict) {
    case Consistency::consistent:
      return "consistent";
    case Consistency::overconfident:
      return "overconfident";
    case Consistency::conservative:
      return "conservative";
    case Consistency::unknown:
      break;
  }
  return "unknown";
}

Consistency MeanNormalizedSquare::verdict() const {
  if (!std::isfinite(mean)) return Consistency::unknown;
  if (mean > band.high) return Consistency::overconfident;
  return mean < band.low ? Consistency::conservative : Consistency::consistent;
}

std::optional<MeanNormalizedSquare> mean_nees_of_run(double mean, std::int64_t samples,
                                                     int degrees_of_freedom) {
  if (samples < fewest_samples || degrees_of_freedom < 1) return std::nullopt;
  return MeanNormalizedSquare{mean, nees_band(1, degrees_of_freedom, band_confidence)};
}

std::optional<MeanNormalizedSquare> mean_nis_of_run(double mean, std::int64_t samples,
                                                    double degrees_of_freedom_in_all) {
  if (samples < fewest_samples || degrees_of_freedom_in_all < 1) return std::nullopt;
  constexpr double most = 1e6;  // far beyond it the chi-square band is narrower than the limits
  Interval band = nees_band(1, static_cast<int>(std::min(degrees_of_freedom_in_all, most)), band_confidence);
  band.low = std::min(band.low, lowest_nis);
  band.high = std::max(band.high, highest_nis);
  return MeanNormalizedSquare{mean, band};
}

}  // namespace incognita
