// Iteration over the features of a camera with their landmarks.
#pragma once

namespace incognita {

/// Calls visit(landmark, feature) for every feature, by id; `visit` may remove the landmark and its feature. Each feature
/// has its landmark, and both maps are sorted by id: walking along both is cheaper than a look-up for each.
template <class SomeEstimate, class Features, class Visit>
void for_each_feature(SomeEstimate& estimate, Features& features, const Visit& visit) {
  auto landmark = estimate.landmarks.begin();
  for (auto feature = features.begin(); feature != features.end();) {
    const auto at = feature++;
    while (landmark->first < at->first) ++landmark;
    const auto of = landmark++;
    visit(of->second, at->second);
  }
}

}  // namespace incognita
