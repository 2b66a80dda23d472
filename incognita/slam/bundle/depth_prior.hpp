// What is known of the depth of a landmark before it is seen from a second place.
#pragma once

namespace incognita {

/// Prior of the inverse depth of a landmark, 1/m.
struct DepthPrior {
  double mean = 0.5, sigma = 0.5;
};

}  // namespace incognita
