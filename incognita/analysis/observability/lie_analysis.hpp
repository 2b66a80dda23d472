// Result of the Lie derivative analysis of a system; computed by lie_derivatives.hpp.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "incognita/analysis/observability/null_space.hpp"

namespace incognita {

struct LieSettings {
  int max_order = 10;
};

/// A derivative of a measurement; its expression is the same for all landmarks.
struct LieRow {
  std::string name;   ///< "L_v L_0 bearing"
  std::string owner;  ///< "vehicle", "landmark" or "anchor"
  int order = 0;
  std::string expression;                                        ///< derivative in named subexpressions
  std::vector<std::pair<std::string, std::string>> definitions;  ///< subexpressions not defined in the file
  std::string latex;                                             ///< "\mathcal{L}_{v} x = ..."
  std::vector<std::string> latex_definitions;                    ///< all subexpressions, as LaTeX
  bool raised_rank = false;
};

struct LieAnalysis {
  NullSpace space;          ///< at the start of the motion
  int order = 0;            ///< highest that increased the rank
  int orders_examined = 0;  ///< highest that was computed
  bool closed = false;      ///< no further derivative can raise the rank; else the limit was hit
  bool missed = false;      ///< a derivative that was rejected as dependent may be independent: not closed
  int generic_rank = 0;     ///< at a point of the region, without the restrictions of the motion
  bool inputs_nonlinear = false;  ///< whether some fields are rates at drawn inputs
  std::vector<std::string> fields;
  std::vector<LieRow> rows;
};

}  // namespace incognita
