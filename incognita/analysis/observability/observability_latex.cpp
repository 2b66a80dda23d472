// Symbolic matrices of a system in LaTeX.
#include <ginac/ginac.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <set>

#include "incognita/analysis/observability/observability.hpp"
#include "incognita/analysis/systems/canonical_expression.hpp"
#include "incognita/analysis/systems/symbolic_system.hpp"

namespace incognita {
namespace {

using GiNaC::ex;
using Slot = ExpressionGraph::Slot;

/// Symbolic F and H of the vehicle with one landmark and one anchor.
struct SymbolicMatrices {
  GiNaC::matrix F, H;
  std::vector<std::string> columns;  // LaTeX names
};

ex entry_of(const SymbolicSystem& s, Slot slot) { return *s.graph[slot].expression; }

/// Names of errors may be arbitrary text.
std::string latex_error(const std::string& name, const LatexNames& names) {
  const bool plain =
      std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  return "\\tilde{" + (plain ? names(name) : "\\text{" + latex_text(name) + "}") + "}";
}

SymbolicMatrices matrices_of(const SymbolicSystem& s, const LatexNames& names) {
  const bool stated = s.text.error_form.has_value();
  const auto n = static_cast<unsigned>(s.columns());
  std::vector<Slot> states = s.vehicle.states;
  states.insert(states.end(), s.landmark.states.begin(), s.landmark.states.end());
  const std::vector<const SymbolicSystem::Block*> blocks{&s.vehicle, &s.landmark, &s.anchor};
  unsigned m = 0;
  for (const auto* block : blocks) m += static_cast<unsigned>(block->measurements.size());
  SymbolicMatrices out{GiNaC::matrix(n, n), GiNaC::matrix(m, n), {}};
  unsigned row_of_F = 0, row_of_H = 0;
  for (const auto* block : blocks) {
    for (const auto& e : block->error_F)
      out.F(static_cast<unsigned>(e.row), static_cast<unsigned>(e.column)) = entry_of(s, e.value);
    for (const auto& e : block->error_H)
      out.H(row_of_H + static_cast<unsigned>(e.row), static_cast<unsigned>(e.column)) = entry_of(s, e.value);
    for (const Slot rate : block->rates) {
      for (unsigned c = 0; c < n && !stated; ++c)
        out.F(row_of_F, c) = s.graph.derivative(entry_of(s, rate), states[c]);
      ++row_of_F;
    }
    for (const Slot measurement : block->measurements) {
      for (unsigned c = 0; c < n && !stated; ++c)
        out.H(row_of_H, c) = s.graph.derivative(entry_of(s, measurement), states[c]);
      ++row_of_H;
    }
  }
  for (const auto* errors : {&s.vehicle_error_names, &s.landmark_error_names})
    for (const std::string& name : *errors) out.columns.push_back(latex_error(name, names));
  return out;
}

std::string array(const std::vector<std::vector<std::string>>& rows) {
  std::string text = "\\begin{bmatrix}\n";
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += (i ? " & " : "  ") + row[i];
    text += " \\\\\n";
  }
  return text + "\\end{bmatrix}";
}

std::vector<std::vector<std::string>> cells(const GiNaC::matrix& M, bool without_empty_rows,
                                            const LatexNames& names) {
  std::vector<std::vector<std::string>> rows;
  for (unsigned r = 0; r < M.rows(); ++r) {
    std::vector<std::string> row;
    bool empty = true;
    for (unsigned c = 0; c < M.cols(); ++c) {
      empty = empty && M(r, c).is_zero();
      row.push_back(in_latex(M(r, c), names));
    }
    if (!empty || !without_empty_rows) rows.push_back(row);
  }
  return rows;
}

/// Nonzero rows of H, H F, ..., up to the last power that is short enough to print.
std::string observability_rows(const SymbolicMatrices& m, const LatexNames& names, bool& cut) {
  std::vector<std::vector<std::string>> rows;
  GiNaC::matrix power = m.H;
  for (unsigned k = 0; k < m.F.rows(); ++k) {
    const auto some = cells(power, true, names);
    if (some.empty()) break;
    rows.insert(rows.end(), some.begin(), some.end());
    GiNaC::matrix next = power.mul(m.F);
    std::size_t size = 0;
    for (unsigned i = 0; i < next.rows(); ++i)
      for (unsigned j = 0; j < next.cols(); ++j) size += tree_size(next(i, j), 100'000);
    constexpr std::size_t longest = 6000;  // nodes: a few pages
    if ((cut = size > longest)) break;
    power = next;
  }
  return array(rows);
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string null_vectors(const std::vector<UnobservableDirection>& directions) {
  if (directions.empty()) return "\\{\\mathbf{0}\\}";
  std::string text = "\\left\\{";
  for (std::size_t i = 0; i < directions.size(); ++i) {
    std::vector<std::vector<std::string>> column;
    for (const double value : directions[i].vector) column.push_back({number(value)});
    text += (i ? ", " : "") + array(column);
  }
  return text + "\\right\\}";
}

/// Definitions of the file that the matrices use, in order.
std::vector<std::string> definitions_of(const SymbolicSystem& s, const SymbolicMatrices& m,
                                        const LatexNames& names) {
  std::set<Slot> used;
  const std::function<void(const ex&)> collect = [&](const ex& e) {
    if (GiNaC::is_a<GiNaC::symbol>(e)) {
      const Slot slot = s.graph.slot_of(GiNaC::ex_to<GiNaC::symbol>(e));
      if (s.graph[slot].expression && used.insert(slot).second) collect(*s.graph[slot].expression);
      return;
    }
    for (std::size_t i = 0; i < e.nops(); ++i) collect(e.op(i));
  };
  for (const auto* M : {&m.F, &m.H})
    for (unsigned r = 0; r < M->rows(); ++r)
      for (unsigned c = 0; c < M->cols(); ++c) collect((*M)(r, c));
  std::vector<std::string> equations;
  for (const Slot slot : used)
    equations.push_back(names(s.graph[slot].name) + " = " + in_latex(*s.graph[slot].expression, names));
  return equations;
}

/// Prints each equation once.
class Equations {
 public:
  std::string operator()(const std::string& equation) {
    constexpr std::size_t longest = 2000;
    if (!printed_.insert(equation).second) return "";
    if (equation.size() <= longest) return "\\[ " + equation + " \\]\n";
    return "% " + equation.substr(0, equation.find(" = ")) + ": too long to print\n";
  }

 private:
  std::set<std::string> printed_;
};

std::string lie_rows(const LieAnalysis& lie, Equations& once) {
  std::string text =
      "% Lie derivatives that raised the rank, (4.61): \\mathcal{L}_{0} along the rates at zero or constant inputs,\n% \\mathcal{L}_{u} along the contribution of input u; x^{(2)}: at other values of the inputs\n";
  for (const LieRow& row : lie.rows) {
    if (!row.raised_rank) continue;
    text += "% " + row.owner + ": " + row.name + "\n";
    if (!row.latex.empty()) text += once(row.latex);
    for (const std::string& part : row.latex_definitions) text += once(part);
  }
  return text;
}

/// Title and columns, before the matrices.
std::string heading(const SystemText& text, const SymbolicMatrices& m) {
  std::string header;
  for (const std::string& column : m.columns) header += (header.empty() ? "" : ",\\; ") + column;
  return "% " + text.name + ": " + text.title + (text.source.empty() ? "" : "; " + text.source) + "\n" +
         "\\setcounter{MaxMatrixCols}{" + std::to_string(std::max<std::size_t>(m.columns.size(), 10)) +
         "}\n% vehicle" + (text.landmark ? ", one feature" : "") + (text.anchor ? ", one anchor" : "") +
         "; columns:\n\\[ " + header + " \\]\n";
}

/// Null spaces of all segments, and along the motion.
std::string null_spaces(const ObservabilityAnalysis& analysis) {
  std::string out = "% at the operating point drawn; features: " + std::to_string(analysis.landmarks) +
                    ", anchors: " + std::to_string(analysis.anchors) + ", motion " + analysis.motion + "\n";
  for (std::size_t k = 0; k < analysis.segments.size(); ++k)
    out += "\\[ \\mathcal{N}(\\mathcal{Q}_{\\mathrm{SOM}," + std::to_string(k + 1) +
           "}) = " + null_vectors(analysis.segments[k].stripped.directions) + " \\]\n";
  std::string names;
  for (const auto& d : analysis.local.directions) names += (names.empty() ? ": " : "; ") + latex_text(d.name);
  return out + "% along the motion" + names +
         "\n\\[ \\mathcal{N}(\\mathbf{M}) = " + null_vectors(analysis.local.directions) + " \\]\n";
}

}  // namespace

std::string observability_latex(const SystemText& text, const ObservabilityAnalysis& analysis) {
  const SymbolicSystem system = make_symbolic(text, analysis.motion);
  const LatexNames names = latex_names(system);
  const SymbolicMatrices m = matrices_of(system, names);
  bool cut = false;
  Equations once;
  std::string out = heading(text, m);
  for (const std::string& definition : definitions_of(system, m, names)) out += once(definition);
  out += "\\[ \\mathbf{F}_j = " + array(cells(m.F, false, names)) + " \\]\n";
  out += "\\[ \\mathbf{H}_j = " + array(cells(m.H, false, names)) + " \\]\n";
  const std::string Q = observability_rows(m, names, cut);
  out += std::string("% rows that are not 0") + (cut ? "; higher powers are too long to print" : "") + "\n";
  out += "\\[ \\mathcal{Q}_j = " + Q + " \\]\n" + null_spaces(analysis);
  if (analysis.lie) out += lie_rows(*analysis.lie, once);
  return out;
}

}  // namespace incognita
