// The colors of match outcomes, the same in every picture.
#pragma once

#include <array>
#include <cstdint>

#include "incognita/slam/mapper/status.hpp"

namespace incognita {

/// Red, green, blue.
inline std::array<std::uint8_t, 3> outcome_color(MatchOutcome outcome) {
  switch (outcome) {
    case MatchOutcome::matched:
      return {60, 220, 90};
    case MatchOutcome::not_found:
      return {235, 60, 60};
    case MatchOutcome::outlier:
      return {220, 60, 220};
    case MatchOutcome::unconfirmed:
      return {240, 170, 40};
    case MatchOutcome::not_searched:
      return {170, 170, 170};
    case MatchOutcome::initialized:
      return {60, 140, 220};
  }
  return {255, 255, 255};
}

}  // namespace incognita
