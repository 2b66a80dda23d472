// The remarks of an observability analysis, for tests.
#pragma once

#include <string>

#include "incognita/analysis/observability/observability.hpp"

namespace incognita::testing {

/// All remarks of an analysis besides ranks.
inline std::string remarks(const ObservabilityAnalysis& a) {
  std::string all;
  for (const auto* lines : {&a.disagreements, &a.doubts, &a.notes})
    for (const std::string& line : *lines) all += line + "\n";
  return all;
}

inline bool says(const ObservabilityAnalysis& a, const std::string& part) {
  return remarks(a).find(part) != std::string::npos;
}

}  // namespace incognita::testing
