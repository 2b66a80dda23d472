// A dynamic system with landmarks as a person writes it down: expressions as text, each with its place in the
// file, so that whoever finds a mistake can say where. docs/add-a-system.md describes the file.
//
// A system is a vehicle (states, known inputs, parameters), a landmark repeated as often as asked, whose
// states are estimated, and an anchor repeated likewise, whose place is known. Expressions of the vehicle see
// the vehicle's names alone; those of a landmark or an anchor see the vehicle's and their own.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace incognita {

/// Of a character in the file; both from 1, 0 where there is no file.
struct SourceLocation {
  int line = 0;
  int column = 0;
};

struct ExpressionText {
  std::string text;
  SourceLocation location;  ///< of the first character of the text
};

struct NamedExpression {
  std::string name;
  SourceLocation location;  ///< of the name
  ExpressionText expression;
};

/// Numbers are drawn from it, evenly.
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

/// A row of a matrix, or a vector: what is not named is 0.
struct SparseRow {
  std::string name;
  SourceLocation location;
  std::vector<NamedExpression> entries;
};

/// Vehicle, landmark or anchor.
struct BlockText {
  std::vector<NamedExpression> states;       ///< name = its rate of change; none for anchors
  std::vector<NamedRange> region;            ///< of each state (of each constant, for anchors)
  std::vector<NamedExpression> definitions;  ///< names for parts of expressions; each sees those before it
  std::vector<MeasurementText> measurements;
  std::vector<SparseRow> error_F;  ///< rows by state; only with an error form
  std::vector<SparseRow> error_H;  ///< rows by measurement; only with an error form
};

/// A direction of the state space that has a name: what it does to the states of the vehicle and of every
/// landmark. Landmarks may also have directions of their own (`depth`), one for each of them.
struct DirectionText {
  std::string name;
  SourceLocation location;
  std::vector<NamedExpression> vehicle;
  std::vector<NamedExpression> landmark;
};

/// A kind of motion: what it makes of inputs and initial states.
struct MotionText {
  std::string name;
  SourceLocation location;
  /// Of a state at the start, of an input or a disturbed state at the start of every segment. What they name
  /// has the value it had before.
  std::vector<NamedExpression> assignments;
  std::vector<NamedRange> draws;  ///< further numbers that the assignments use, drawn each segment
};

/// The system in error coordinates, where they are not the plain differences of its states.
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
  std::string file;  ///< as it was asked for, for messages
  std::string name;
  std::string title;
  std::string source;
  std::string representation = "world";  ///< or "relative"
  double segment_duration_s = 1;
  std::vector<NamedNumber> parameters;
  std::vector<NamedRange> inputs;  ///< known, held for a segment
  /// States of the vehicle that change by an unknown amount from one segment to the next: what accelerates it
  /// is not measured.
  std::vector<DisturbedState> disturbed;
  BlockText vehicle;
  std::optional<BlockText> landmark;
  std::optional<BlockText> anchor;
  std::vector<DirectionText> directions;
  std::vector<DirectionText> landmark_directions;  ///< one for each landmark; `landmark` holds the entries
  std::vector<MotionText> motions;                 ///< besides `general`, which every system knows
  std::optional<ErrorFormText> error_form;
};

}  // namespace incognita
