#pragma once

#include <string>

#include "incognita/world/replay/range_recording.hpp"

namespace incognita {

inline std::string all_notes(const RangeRecording& recording) {
  std::string all;
  for (const std::string& note : recording.notes) all += note + "\n";
  return all;
}

}  // namespace incognita
