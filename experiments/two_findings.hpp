// Claims of Chapter 4 with two findings: what is true of a system, and what the method of the thesis says of
// it. observability_claims.hpp says by what each is decided.
#pragma once

#include <string>
#include <utility>

#include "experiments/evidence.hpp"

namespace incognita {

/// Whether the printed statement is true of the motion itself; `instead` as for assessed().
struct InTruth {
  Answer printed;
  Instead instead = in_truth(Answer::refuted);
};

/// Whether the method of the thesis, which freezes F and H within a segment, says the printed statement.
struct ByMethod {
  Answer printed;
  Instead instead = in_truth(Answer::refuted);
};

/// The claim with both findings.
inline Claim assessed(std::string id, std::string place, std::string statement, Evidence evidence,
                      const InTruth& truth, const ByMethod& method) {
  return by_the_method(assessed(std::move(id), std::move(place), std::move(statement), std::move(evidence),
                                truth.printed, truth.instead),
                       method.printed, method.instead);
}

inline const char* yes_no(bool it_is) { return it_is ? "yes" : "no"; }

}  // namespace incognita
