#include "experiments/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace incognita {
namespace {

Claim undecided(Claim claim, std::string why) {
  claim.verdict = Verdict::undecided;
  claim.why = std::move(why);
  return claim;
}

}  // namespace

Finding is_above(const Interval& i, double bound) {
  if (i.low > bound) return Finding::shown;
  return i.high <= bound ? Finding::refuted : Finding::undecided;
}

Finding is_below(const Interval& i, double bound) {
  if (i.high < bound) return Finding::shown;
  return i.low >= bound ? Finding::refuted : Finding::undecided;
}

Finding agrees(const Interval& i, double value, double margin) {
  return is_above(i, value - margin) && is_below(i, value + margin);
}

Finding differs(const Interval& i, double value) {
  return i.low > value || i.high < value ? Finding::shown : Finding::undecided;
}

Finding happens_in(double share, RunCount count, RunCount of) {
  return is_above(
      share_of(static_cast<std::size_t>(count.value), static_cast<std::size_t>(of.value), shown_at), share);
}

std::string text(const Interval& i, const std::string& unit) {
  if (!std::isfinite(i.value)) return "unknown (no runs to compare)";
  const std::string value = fmt::format("{:.3g}{}{}", i.value, unit.empty() ? "" : " ", unit);
  if (!std::isfinite(i.low) || !std::isfinite(i.high)) return value + " (too few runs for an interval)";
  return fmt::format("{} ({:.3g} to {:.3g})", value, i.low, i.high);
}

std::string decimals(double x, int digits) {
  return std::isfinite(x) ? fmt::format("{:.{}f}", x, digits) : "unknown";
}

std::string below(double difference) {
  const double exponent = std::floor(std::log10(std::max(std::abs(difference), 1e-13))) + 1;
  return fmt::format("below 1e{:.0f}", exponent);
}

Claim assessed(Claim claim, Finding printed, Finding corrected) {
  if (claim.runs < claim.least_runs)
    return undecided(std::move(claim), fmt::format("it rests on {} run{}, and takes at least {}", claim.runs,
                                                   claim.runs == 1 ? "" : "s", claim.least_runs));
  if (printed == Finding::undecided) return undecided(std::move(claim), "the interval holds both answers");
  if (printed == Finding::refuted && corrected == Finding::undecided)
    return undecided(std::move(claim), "not as printed; whether as corrected, the interval leaves open");
  claim.verdict = printed == Finding::shown     ? Verdict::holds
                  : corrected == Finding::shown ? Verdict::holds_as_corrected
                                                : Verdict::does_not_hold;
  if (claim.verdict == Verdict::holds) claim.why.clear();
  if (claim.verdict == Verdict::does_not_hold && claim.why.empty()) claim.why = "not investigated";
  return claim;
}

Claim assessed(std::string id, std::string place, std::string statement, Evidence r, Finding printed,
               Finding corrected) {
  const bool by_chance = r.seeds.value >= 0;
  return assessed({.id = std::move(id),
                   .place = std::move(place),
                   .statement = std::move(statement),
                   .printed = std::move(r.printed.words),
                   .measured = std::move(r.measured.words),
                   .why = std::move(r.why.words),
                   .runs = by_chance ? r.seeds.value : r.runs.value,
                   .least_runs = by_chance ? enough_runs : 1,
                   .timed = r.timed},
                  printed, corrected);
}

}  // namespace incognita
