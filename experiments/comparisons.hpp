// Claims that make several comparisons, e.g. with each of several rivals: they hold if all of these do, and are cited by
// the number of the one on which the finding turns.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "experiments/evidence.hpp"

namespace incognita {

struct Comparison {
  std::string rival;
  ClaimNumber number;
  Answer answer;
  double margin;  ///< between the interval and the bound; negative where not all of it is on the claimed side
};

/// The claim that the number is below the bound, or above it.
inline Comparison claimed_below(std::string rival, ClaimNumber number, double bound) {
  const Interval& i = number.value;
  const Answer answer = is_below(i, bound);
  const double margin = bound - i.high;
  return {std::move(rival), std::move(number), answer, margin};
}
inline Comparison claimed_above(std::string rival, ClaimNumber number, double bound) {
  const Interval& i = number.value;
  const Answer answer = is_above(i, bound);
  const double margin = i.low - bound;
  return {std::move(rival), std::move(number), answer, margin};
}

inline Answer all_shown(const std::vector<Comparison>& all) {
  Answer answer = Answer::shown;
  for (const Comparison& one : all) answer = answer && one.answer;
  return answer;
}

inline Answer any_shown(const std::vector<Comparison>& all) {
  Answer answer = Answer::refuted;
  for (const Comparison& one : all) answer = answer || one.answer;
  return answer;
}

/// Of the comparisons with the answer of all together, the number of the one with the least margin. `all` is not empty.
inline ClaimNumber deciding(const std::vector<Comparison>& all) {
  const Answer answer = all_shown(all);
  const Comparison* decides = nullptr;
  for (const Comparison& one : all)
    if (one.answer == answer && (!decides || one.margin < decides->margin)) decides = &one;
  return decides->number;
}

/// Which comparisons have the answer and which not: `less than X; not less than Y; undecided against Z`.
std::string condition(const std::string& less_than, const std::vector<Comparison>& all);

}  // namespace incognita
