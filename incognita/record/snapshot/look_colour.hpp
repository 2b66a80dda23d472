// The colours in which a look's outcome is drawn, the same in every picture.
#pragma once

#include <array>
#include <cstdint>

#include "incognita/slam/mapper/status.hpp"

namespace incognita {

/// Red, green, blue.
inline std::array<std::uint8_t, 3> look_colour(LookOutcome outcome) {
  switch (outcome) {
    case LookOutcome::matched:
      return {60, 220, 90};
    case LookOutcome::not_found:
      return {235, 60, 60};
    case LookOutcome::inconsistent:
      return {220, 60, 220};
    case LookOutcome::alone:
      return {240, 170, 40};
    case LookOutcome::not_tried:
      return {170, 170, 170};
    case LookOutcome::born:
      return {60, 140, 220};
  }
  return {255, 255, 255};
}

}  // namespace incognita
