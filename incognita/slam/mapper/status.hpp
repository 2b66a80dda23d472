// The tracking status of an estimator, with its reason.
#pragma once

#include <string>

namespace incognita {

enum class TrackingState { starting, tracking, degraded, lost, relocated };

inline const char* name(TrackingState state) {
  switch (state) {
    case TrackingState::starting:
      return "starting";
    case TrackingState::tracking:
      return "tracking";
    case TrackingState::degraded:
      return "degraded";
    case TrackingState::lost:
      return "lost";
    case TrackingState::relocated:
      return "relocated";
  }
  return "unknown";
}

/// Outcome of the measurement of one landmark at a tick.
enum class MatchOutcome {
  matched,
  not_found,
  outlier,
  unconfirmed,  ///< re-detected, but no other match constrains it
  not_searched,
  initialized,  ///< used to initialize a new landmark
};

inline const char* name(MatchOutcome outcome) {
  switch (outcome) {
    case MatchOutcome::matched:
      return "matched";
    case MatchOutcome::not_found:
      return "not-found";
    case MatchOutcome::outlier:
      return "outlier";
    case MatchOutcome::unconfirmed:
      return "unconfirmed";
    case MatchOutcome::not_searched:
      return "not-searched";
    case MatchOutcome::initialized:
      return "initialized";
  }
  return "unknown";
}

/// Of an image with a rolling shutter.
struct Readout {
  bool of_columns = false;  ///< else of rows
  double s = 0;             ///< from the first to the last of them; negative: the last is exposed first
};

struct TrackingStatus {
  TrackingState state = TrackingState::starting;
  /// States values and limits, e.g. "fewer than 3 features matched; 2 of 12 features matched"
  std::string reason;
};

}  // namespace incognita
