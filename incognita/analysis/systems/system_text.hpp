// Text description of a dynamic system with landmarks: expressions with their locations in the file, for
// error messages. docs/add-a-system.md describes the file format.
//
// A system is a vehicle (states, known inputs, parameters), a landmark, repeated as often as asked, whose
// states are estimated, and an anchor, likewise repeated, whose position is known. Expressions of the vehicle
// may use only the vehicle's names; those of a landmark or an anchor also their own.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace incognita {

/// Location of a character in the file; both from 1, 0 without a file.
struct SourceLocation {
  int line = 0;
  int column = 0;
};

struct ExpressionText {
  std::string text;
  SourceLocation location;  ///< position of the first character
};

struct NamedExpression {
  std::string name;
  SourceLocation location;  ///< position of the name
  ExpressionText expression;
};

/// Range for uniform random draws.
struct NamedRange {
  std::string name;
  SourceLocation location;
  double low = 0;
  double high = 0;
};

struct NamedNumber {
  std::string name;
  SourceLocation location;
  double value = 0;
};

struct MeasurementText {
  std::string name;
  SourceLocation location;
  ExpressionText expression;
  double sigma = 1;  ///< standard deviation of its noise, in its own unit; > 0
};

/// A row of a matrix, or a vector; entries not listed are 0.
struct SparseRow {
  std::string name;
  SourceLocation location;
  std::vector<NamedExpression> entries;
};

/// Vehicle, landmark or anchor.
struct BlockText {
  std::vector<NamedExpression> states;       ///< name = its time derivative; none for anchors
  std::vector<NamedRange> region;            ///< range of each state, or of each constant of an anchor
  std::vector<NamedExpression> definitions;  ///< named subexpressions; each may use earlier ones
  std::vector<MeasurementText> measurements;
  std::vector<SparseRow> error_F;  ///< rows by state; only with an error form
  std::vector<SparseRow> error_H;  ///< rows by measurement; only with an error form
};

/// A named direction of the state space: its components for the vehicle and for every landmark. Landmarks may
/// also have directions of their own (`depth`), one per landmark.
struct DirectionText {
  std::string name;
  SourceLocation location;
  std::vector<NamedExpression> vehicle;
  std::vector<NamedExpression> landmark;
};

/// A kind of motion: how it sets inputs and initial states.
struct MotionText {
  std::string name;
  SourceLocation location;
  /// For a state at the start; for an input or a disturbed state at the start of every segment. Names refer
  /// to the values before.
  std::vector<NamedExpression> assignments;
  std::vector<NamedRange> draws;  ///< further random numbers for the assignments, drawn per segment
};

/// The system in error coordinates, if they are not plain differences of the states.
struct ErrorFormText {
  std::string source;
  std::vector<NamedExpression> names;  ///< state -> name of its error (text, not an expression)
  std::vector<DirectionText> directions;
  std::vector<DirectionText> landmark_directions;
};

struct DisturbedState {
  std::string name;
  SourceLocation location;
};

struct SystemText {
  std::string file;  ///< as requested, for messages
  std::string name;
  std::string title;
  std::string source;
  std::string representation = "world";  ///< or "relative"
  double segment_duration_s = 1;
  std::vector<NamedNumber> parameters;
  std::vector<NamedRange> inputs;  ///< known, held within a segment
  /// States of the vehicle that change by an unknown amount between segments, since its acceleration is not measured.
  std::vector<DisturbedState> disturbed;
  BlockText vehicle;
  std::optional<BlockText> landmark;
  std::optional<BlockText> anchor;
  std::vector<DirectionText> directions;
  std::vector<DirectionText> landmark_directions;  ///< one per landmark; `landmark` holds the entries
  std::vector<MotionText> motions;                 ///< besides `general`, which every system has
  std::optional<ErrorFormText> error_form;
};

}  // namespace incognita
