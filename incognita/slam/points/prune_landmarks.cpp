#include "incognita/slam/points/prune_landmarks.hpp"

#include <algorithm>

#include "incognita/slam/mapper/landmarks.hpp"
#include "incognita/slam/mapper/measurements.hpp"

namespace incognita {
namespace {

bool is_of(const Match& match, int body, int sensor) {
  return match.body == body && match.sensor == sensor && !match.of_body && !match.image;
}

bool corrected(const Match& match) { return match.outcome == MatchOutcome::matched; }

/// Whether a body matched a landmark with any of its point sensors.
bool matched_any(const Estimate& e, int body) {
  return std::ranges::any_of(e.last.matches, [&](const Match& match) {
    return match.body == body && !match.of_body && !match.image && corrected(match);
  });
}

}  // namespace

void LandmarkPruning::Reach::extend(const SmallVector& z) {
  if (least.size() != z.size()) least = most = z;
  least = least.cwiseMin(z);
  most = most.cwiseMax(z);
}

/// A tenth of the extent from every limit, where detections are rare.
bool LandmarkPruning::Reach::is_well_inside(const SmallVector& z) const {
  if (least.size() != z.size()) return false;
  const SmallVector margin = 0.1 * (most - least);
  return ((z - least).array() >= margin.array()).all() && ((most - z).array() >= margin.array()).all();
}

void LandmarkPruning::update(Estimate& e, const EstimatorSettings& settings) {
  if (!(settings.pruning.min_detected_share > 0) ||
      settings.association.method == DataAssociationSettings::Method::known)
    return;
  reaches_.resize(e.bodies.size());
  for (std::size_t i = 0; i < reaches_.size(); ++i) reaches_[i].resize(settings.bodies[i].sensors.size());
  extend_reaches(e);
  for (std::size_t i = 0; i < reaches_.size(); ++i)
    for (std::size_t k = 0; k < reaches_[i].size(); ++k)
      count(e, static_cast<int>(i), static_cast<int>(k), settings);
  prune(e, settings.pruning);
}

void LandmarkPruning::extend_reaches(const Estimate& e) {
  for (const Match& match : e.last.matches)
    if (!match.of_body && !match.image && corrected(match))
      reaches_[static_cast<std::size_t>(match.body)][static_cast<std::size_t>(match.sensor)].extend(
          match.measured);
}

/// Counts the landmarks that one sensor is expected to detect at this tick, and those that it does.
void LandmarkPruning::count(Estimate& e, int body, int sensor, const EstimatorSettings& settings) {
  const auto is_own = [&](const Match& match) { return is_of(match, body, sensor); };
  if (std::ranges::none_of(e.last.matches, is_own) || !matched_any(e, body)) return;
  matched_.clear();
  for (const Match& match : e.last.matches)
    if (is_own(match) && corrected(match)) matched_.push_back(match.id);
  std::ranges::sort(matched_);
  const Reach& reach = reaches_[static_cast<std::size_t>(body)][static_cast<std::size_t>(sensor)];
  for (auto& [id, landmark] : e.landmarks) {
    if (landmark.fixed) continue;
    const auto z = predict_in_view(e, landmark, body, sensor, settings);
    if (!z || !reach.is_well_inside(*z)) continue;
    ++landmark.expected_scans;
    landmark.detected_scans += std::ranges::binary_search(matched_, id);
  }
}

void LandmarkPruning::prune(Estimate& e, const PruningSettings& settings) {
  for (auto next = e.landmarks.begin(); next != e.landmarks.end();) {
    const Landmark& landmark = (next++)->second;
    if (landmark.fixed || landmark.expected_scans < settings.min_expected_scans) continue;
    if (landmark.detected_scans < settings.min_detected_share * landmark.expected_scans)
      remove_landmark(e, landmark.id);
  }
}

}  // namespace incognita
