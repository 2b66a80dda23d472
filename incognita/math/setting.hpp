// Declarations of settings. A settings struct declares each member once, beside the struct:
//
//   struct SearchSettings {
//     double gate_sigmas = 3;
//     static void describe(auto&& setting) {
//       setting(&SearchSettings::gate_sigmas, "gate_sigmas", "", limits::above_up_to(0, 100), "Half axes of ...");
//     }
//   };
//
// that is member, key, unit (empty for ratios, counts and words), limits, and one sentence. Reading of files, checks,
// `incognita config` and the documentation all use this declaration.
#pragma once

#include <limits>

namespace incognita {

/// The admissible numbers of a setting; for a list, of each of its numbers.
struct Limits {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool more_than_least = false;  ///< `least` itself is excluded
  bool odd = false;              ///< even numbers are excluded
};

namespace limits {

constexpr Limits any() { return {}; }
constexpr Limits at_least(double least) { return {.least = least}; }
constexpr Limits more_than(double least) { return {.least = least, .more_than_least = true}; }
constexpr Limits between(double least, double most) { return {.least = least, .most = most}; }
constexpr Limits above_up_to(double least, double most) {
  return {.least = least, .most = most, .more_than_least = true};
}
constexpr Limits odd_between(double least, double most) {
  return {.least = least, .most = most, .odd = true};
}

}  // namespace limits
}  // namespace incognita
