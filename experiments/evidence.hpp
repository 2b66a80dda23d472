// From runs to verdicts: how what chance leaves open is put into words, and how a claim is judged.
//
// Intervals are 95 % where they are shown. A claim that something equals its prediction is judged at 99.9 %,
// so that a true one seldom fails when the number of runs is another.
#pragma once

#include <string>

#include "incognita/analysis/statistics.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita {

inline constexpr double shown = usual_confidence, judged_at = 0.999;

/// `0.158 m (0.143 to 0.176)`
std::string text(const Interval& interval, const std::string& unit = "");

/// What is as good as zero, the same on every processor: the power of ten it stays below, `below 1e-9`; 1e-12
/// at least.
std::string below(double difference);

/// The claim with its verdict. `printed`: what the thesis says passed; else `corrected`: what `why` says
/// instead did. Where the claim holds as it is there is nothing to explain, and `why` goes.
Claim judged(Claim claim, bool printed, bool corrected = false);

}  // namespace incognita
