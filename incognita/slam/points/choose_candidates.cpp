#include "incognita/slam/points/choose_candidates.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "incognita/slam/mapper/measurements.hpp"

namespace incognita {
namespace {

/// Index of a body, and of a sensor that it carries.
using OfBody = std::pair<int, int>;

/// Whether a sensor matched this detection with a landmark, an anchor or a depth line.
bool shows_feature(const Match& match, OfBody of) {
  return OfBody{match.body, match.sensor} == of && !match.of_body && !match.image &&
         match.outcome == MatchOutcome::matched;
}

/// Landmarks and anchors predicted in the view of a sensor, and depth lines that it detected.
int visible(const Estimate& e, OfBody of, const EstimatorSettings& settings) {
  const auto points = std::ranges::count_if(e.landmarks, [&](const auto& entry) {
    return predict_in_view(e, entry.second, of.first, of.second, settings).has_value();
  });
  const auto lines = std::ranges::count_if(e.last.matches, [&](const Match& match) {
    return match.ray && shows_feature(match, of) && !e.landmarks.at(match.id).mapped();
  });
  return static_cast<int>(points + lines);
}

/// Where the features of a sensor are in this image.
std::vector<MeasurementVector> features(const Estimate& e, OfBody of) {
  std::vector<MeasurementVector> pixels;
  for (const Match& match : e.last.matches)
    if (shows_feature(match, of)) pixels.push_back(match.measured);
  return pixels;
}

double distance2_to_nearest(const MeasurementVector& pixel, const std::vector<MeasurementVector>& others) {
  double least = std::numeric_limits<double>::infinity();
  for (const MeasurementVector& other : others) least = std::min(least, (pixel - other).squaredNorm());
  return least;
}

/// Moves the candidates that are chosen to `chosen`, `count` at most.
void choose(const Estimate& e, OfBody of, std::vector<std::size_t> candidates, int count,
            std::vector<std::size_t>& chosen) {
  std::vector<MeasurementVector> taken = features(e, of);
  for (; count > 0 && !candidates.empty(); --count) {
    const auto farthest = std::ranges::max_element(candidates, {}, [&](std::size_t candidate) {
      return distance2_to_nearest(e.last.matches[candidate].measured, taken);
    });
    taken.push_back(e.last.matches[*farthest].measured);
    chosen.push_back(*farthest);
    candidates.erase(farthest);
  }
}

}  // namespace

std::vector<std::size_t> chosen_candidates(const Estimate& e, const std::vector<std::size_t>& candidates,
                                           const EstimatorSettings& settings) {
  if (settings.wanted_visible == 0) return candidates;
  std::map<OfBody, std::vector<std::size_t>> of_sensor;
  for (const std::size_t candidate : candidates) {
    const Match& match = e.last.matches[candidate];
    of_sensor[{match.body, match.sensor}].push_back(candidate);
  }
  std::vector<std::size_t> chosen;
  for (const auto& [of, own] : of_sensor)
    choose(e, of, own, settings.wanted_visible - visible(e, of, settings), chosen);
  return chosen;
}

}  // namespace incognita
