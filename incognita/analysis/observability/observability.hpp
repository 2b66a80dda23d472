// What can be seen of a system, and what cannot: the analyses of thesis Chapter 4 side by side, for one
// system, one kind of motion, and so many landmarks and anchors.
//
// Four answers to the same question. The stripped and total observability matrices (SOM, TOM; Goshen-Meskin,
// Bar-Itzhack, IEEE TAES 1992) of piecewise constant segments freeze H inside each, and may find too much;
// the local observability matrix along the motion is what a filter with exact Jacobians would live on; the
// Lie derivatives ask what the best motion of this kind could show; the Fisher information, how well.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/observability/lie_analysis.hpp"
#include "incognita/analysis/observability/null_space.hpp"
#include "incognita/analysis/systems/linearization.hpp"
#include "incognita/analysis/systems/system_text.hpp"

namespace incognita {

struct ObservabilitySettings {
  int landmarks = 1;
  int anchors = 0;
  int segments = 3;
  std::string motion = "general";
  std::uint64_t seed = 1;
  bool lie = true;
  LieSettings lie_settings = {};
  NullSpaceSettings rank = {};
};

/// A vector of the null space, and what it is.
struct UnobservableDirection {
  std::string name;  ///< of the system's file; a state; or the combination written out
  Eigen::VectorXd vector;
};

/// A matrix, what it does not see, and in what words.
struct ObservableSpace {
  NullSpace space;
  std::vector<UnobservableDirection> directions;  ///< as many as the nullity; they span the null space
};

/// Segments 1 to k together.
struct SegmentAnalysis {
  ObservableSpace stripped, total;
  bool condition_holds = false;  ///< (4.9), in every segment up to here
};

struct StateInformation {
  std::string state;
  std::optional<double>
      sigma;  ///< least standard deviation that the motion allows (Cramer, Rao); none: unobservable
  double region_width = 0;         ///< 0: its start is given
  bool weakly_observable = false;  ///< sigma is much larger than the region: seen in principle only
};

struct ObservabilityAnalysis {
  std::string system, representation, motion;
  int landmarks = 0, anchors = 0;
  std::vector<std::string> states;          ///< of the equations: local, Lie, Fisher
  std::vector<std::string> error_states;    ///< of the error form: SOM, TOM
  std::vector<std::string> inputs;          ///< names, in the order of SystemPoint::u
  std::vector<std::string> constants;       ///< of one anchor, in the order of SystemPoint::anchors
  std::vector<SystemPoint> points;          ///< where each segment begins
  std::vector<double> durations_s;          ///< of each segment
  int measurements_per_segment = 0;         ///< its end is the start of the next, or the last look of all
  std::vector<double> measurement_times_s;  ///< of all looks along the motion, from its start
  std::vector<Linearization> error_forms;   ///< F and H of each segment
  std::vector<SegmentAnalysis> segments;
  ObservableSpace local, fisher;
  double growth =
      1;  ///< of small differences along the motion: the largest entry of a transition from its start
  std::vector<StateInformation> information;
  bool sigmas_trusted = true;  ///< the rank they rest on is clear, and no digits were lost on the way
  std::optional<LieAnalysis> lie;
  std::vector<UnobservableDirection> lie_directions;
  std::vector<std::string> disagreements;  ///< of the methods, and why
  std::vector<std::string> doubts;         ///< ranks that are not clear, limits that were hit
  std::vector<std::string> notes;  ///< what ranks do not tell: barely seen states, inputs that nothing uses
};

/// Throws SystemError, with the place in the file; std::invalid_argument for what the system does not have.
ObservabilityAnalysis analyze_observability(const SystemText& text, const ObservabilitySettings& settings);

/// The matrices in symbols: F, H and the rows of the observability matrix of one segment (4.6), of the
/// vehicle with one landmark and one anchor, as LaTeX; and the Lie rows.
std::string observability_latex(const SystemText& text, const ObservabilityAnalysis& analysis);

}  // namespace incognita
