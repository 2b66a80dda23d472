#include "incognita/io/recordings/clock_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "incognita/analysis/evaluation/statistics.hpp"

namespace incognita {
namespace {

template <class Row>
std::vector<double> times_of(const std::vector<Row>& rows) {
  std::vector<double> times;
  for (const Row& row : rows) times.push_back(row.t);
  return times;
}

std::vector<double> intervals_of(const std::vector<double>& times) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times.size(); ++i) intervals.push_back(times[i] - times[i - 1]);
  return intervals;
}

/// Odometry and scans of the same drive overlap nearly completely.
std::optional<std::string> barely_overlap(const std::vector<double>& odometry,
                                          const std::vector<double>& scans) {
  constexpr double least_share = 0.5;
  const double common = std::min(odometry.back(), scans.back()) - std::max(odometry.front(), scans.front());
  const double longer = std::max(odometry.back() - odometry.front(), scans.back() - scans.front());
  if (common >= least_share * longer) return std::nullopt;
  return fmt::format(
      "the odometry ({} s to {} s) and the scans ({} s to {} s) overlap by only {:.3g} % of the longer one: check that both are in s and on the same clock",
      odometry.front(), odometry.back(), scans.front(), scans.back(), 100 * common / longer);
}

struct HeldReading {
  double t = 0, for_s = 0;
};

/// The odometry reading that is held longest during the scans.
HeldReading longest_held(std::vector<double> odometry, const std::vector<double>& scans) {
  odometry.push_back(std::max(odometry.back(), scans.back()));
  HeldReading longest;
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    const double from = std::max(odometry[i - 1], scans.front()), to = std::min(odometry[i], scans.back());
    if (to - from > longest.for_s) longest = {odometry[i - 1], to - from};
  }
  return longest;
}

std::optional<std::string> held_for_long(const std::vector<double>& odometry,
                                         const std::vector<double>& scans) {
  constexpr double most_intervals = 10, shortest_s = 5;  // valid recordings have gaps of up to 1.4 s
  if (odometry.size() < 2 || scans.size() < 2) return std::nullopt;
  const double odometry_s = median_of(intervals_of(odometry)), scans_s = median_of(intervals_of(scans));
  const HeldReading held = longest_held(odometry, scans);
  if (held.for_s < shortest_s || held.for_s <= most_intervals * std::min(odometry_s, scans_s))
    return std::nullopt;
  return fmt::format(
      "the odometry reading of {} s is held for {:.3g} s; the median interval is {:.3g} s between readings and {:.3g} s between scans: check that both are in s and on the same clock",
      held.t, held.for_s, odometry_s, scans_s);
}

}  // namespace

std::vector<std::string> clock_warnings(const RangeRecording& recording) {
  std::vector<std::string> warnings;
  if (recording.odometry.empty() || recording.scans.empty()) return warnings;
  const std::vector<double> odometry = times_of(recording.odometry), scans = times_of(recording.scans);
  for (auto& warning : {barely_overlap(odometry, scans), held_for_long(odometry, scans)})
    if (warning) warnings.push_back(*warning);
  return warnings;
}

}  // namespace incognita
