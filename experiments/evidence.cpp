#include "experiments/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace incognita {

std::string text(const Interval& i, const std::string& unit) {
  return fmt::format("{:.3g}{}{} ({:.3g} to {:.3g})", i.value, unit.empty() ? "" : " ", unit, i.low, i.high);
}

std::string below(double difference) {
  const double exponent = std::floor(std::log10(std::max(std::abs(difference), 1e-13))) + 1;
  return fmt::format("below 1e{:.0f}", exponent);
}

Claim judged(Claim claim, bool printed, bool corrected) {
  claim.verdict = printed ? Verdict::holds : corrected ? Verdict::holds_as_corrected : Verdict::does_not_hold;
  if (printed) claim.why.clear();
  return claim;
}

}  // namespace incognita
