#include "experiments/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/headlines.hpp"
#include "experiments/quotations.hpp"

namespace incognita {
namespace {

Claim undecided(Claim claim, std::string why) {
  claim.finding = Finding::undecided;
  claim.why = std::move(why);
  return claim;
}

Finding found(Answer printed, const Instead& instead) {
  if (printed == Answer::shown) return Finding::holds;
  if (printed == Answer::undecided) return Finding::undecided;
  return instead.answer == Answer::shown ? instead.found : Finding::does_not_hold;
}

/// Why a claim does not hold: the diagnosis `why` if it is shown.
std::string reason_if_shown(std::string why, Answer diagnosis) {
  if (why.empty() || diagnosis == Answer::refuted) return "not investigated";
  return diagnosis == Answer::shown ? why
                                    : "not known: whether it is as was tested, the interval leaves open";
}

}  // namespace

Answer is_above(const Interval& i, double bound) {
  if (i.low > bound) return Answer::shown;
  return i.high <= bound ? Answer::refuted : Answer::undecided;
}

Answer is_below(const Interval& i, double bound) {
  if (i.high < bound) return Answer::shown;
  return i.low >= bound ? Answer::refuted : Answer::undecided;
}

Answer agrees(const Interval& i, double value, double margin) {
  return is_above(i, value - margin) && is_below(i, value + margin);
}

Answer differs(const Interval& i, double value) {
  return i.low > value || i.high < value ? Answer::shown : Answer::undecided;
}

Answer happens_in(double share, RunCount count, RunCount of) {
  return is_above(share_of(static_cast<std::size_t>(count.value), static_cast<std::size_t>(of.value)), share);
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

Claim assessed(Claim claim, Answer printed, Instead instead) {
  claim.source = source_of(claim.id);
  claim.headline = headline_of(claim.id);
  if (claim.runs < claim.least_runs)
    return undecided(std::move(claim), fmt::format("it rests on {} run{}, and takes at least {}", claim.runs,
                                                   claim.runs == 1 ? "" : "s", claim.least_runs));
  if (printed == Answer::undecided) return undecided(std::move(claim), "the interval holds both answers");
  const bool contradicts = instead.found == Finding::does_not_hold;
  if (printed == Answer::refuted && instead.answer == Answer::undecided && !contradicts)
    return undecided(std::move(claim), "not as printed; whether as corrected, the interval leaves open");
  claim.finding = found(printed, instead);
  if (claim.finding == Finding::holds) claim.why.clear();
  if (claim.finding == Finding::does_not_hold)
    claim.why = reason_if_shown(std::move(claim.why), instead.answer);
  return claim;
}

Claim by_the_method(Claim claim, Answer printed, Instead instead) {
  claim.by_method = found(printed, instead);
  return claim;
}

Claim assessed(std::string id, std::string place, std::string statement, Evidence r, Answer printed,
               Instead instead) {
  const bool by_chance = r.seeds.value >= 0;
  return assessed({.id = std::move(id),
                   .place = std::move(place),
                   .statement = std::move(statement),
                   .printed = std::move(r.printed.words),
                   .measured = std::move(r.measured.words),
                   .why = std::move(r.why.words),
                   .runs = by_chance ? r.seeds.value : r.runs.value,
                   .least_runs = by_chance ? enough_runs : 1,
                   .timed = r.timed,
                   .rule = r.rule,
                   .number = std::move(r.number)},
                  printed, instead);
}

}  // namespace incognita
