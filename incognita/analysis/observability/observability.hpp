// Observability of a system: the analyses of thesis Chapter 4 side by side, for one system, one kind of
// motion, and given numbers of landmarks and anchors.
//
// Four methods are compared. The stripped and total observability matrices (SOM, TOM; Goshen-Meskin, Bar-Itzhack,
// IEEE TAES 1992) of piecewise constant segments freeze H within each segment and may overestimate the rank. The
// local observability matrix along the motion is that of a filter with exact Jacobians. The Lie derivatives give what
// the best motion of this kind could observe. The Fisher information gives how well.
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

/// A vector of the null space, with its name.
struct UnobservableDirection {
  std::string name;  ///< named by the system's file; a state; or the combination written out
  Eigen::VectorXd vector;
};

/// The null space of a matrix, with named directions.
struct ObservableSpace {
  NullSpace space;
  std::vector<UnobservableDirection> directions;  ///< as many as the nullity; they span the null space
};

/// Segments 1 to k together.
struct SegmentAnalysis {
  ObservableSpace stripped, total;
  bool condition_holds = false;  ///< (4.9), in every segment so far
};

struct StateInformation {
  std::string state;
  /// Cramer-Rao bound of the standard deviation for this motion; empty: unobservable.
  std::optional<double> sigma;
  double region_width = 0;         ///< 0: its start is given
  bool weakly_observable = false;  ///< sigma is much larger than the region: observable only in theory
};

struct ObservabilityAnalysis {
  std::string system, representation, motion;
  int landmarks = 0, anchors = 0;
  std::vector<std::string> states;        ///< names in the state equations: local, Lie, Fisher
  std::vector<std::string> error_states;  ///< names in the error form: SOM, TOM
  std::vector<std::string> inputs;        ///< names, in the order of SystemPoint::u
  /// Names of one anchor's constants, in the order of SystemPoint::anchors.
  std::vector<std::string> constants;
  std::vector<SystemPoint> points;  ///< start of each segment
  std::vector<double> durations_s;  ///< one per segment
  /// The end of a segment is the start of the next, or the last measurement.
  int measurements_per_segment = 0;
  std::vector<double> measurement_times_s;    ///< all measurements along the motion, from its start
  std::vector<LinearizedSystem> error_forms;  ///< F and H of each segment
  std::vector<SegmentAnalysis> segments;
  ObservableSpace local, fisher;
  /// Of small differences along the motion: largest entry of the transitions from its start.
  double growth = 1;
  std::vector<StateInformation> information;
  bool sigmas_trusted = true;  ///< their rank is clear, and no digits were lost along the motion
  std::optional<LieAnalysis> lie;
  std::vector<UnobservableDirection> lie_directions;
  std::vector<std::string> disagreements;  ///< between the methods, with the reasons
  std::vector<std::string> doubts;         ///< ambiguous ranks, limits that were hit
  std::vector<std::string> notes;          ///< beyond the ranks: weakly observable states, unused inputs
};

/// Throws SystemError, with the location in the file, and std::invalid_argument for settings that the system
/// does not support.
ObservabilityAnalysis analyze_observability(const SystemText& text, const ObservabilitySettings& settings);

/// Symbolic matrices as LaTeX: F, H and the rows of the observability matrix of one segment (4.6), for the
/// vehicle with one landmark and one anchor; and the Lie rows.
std::string observability_latex(const SystemText& text, const ObservabilityAnalysis& analysis);

}  // namespace incognita
