// From runs to verdicts: how an interval is written, what it shows, and how a claim is assessed.
//
// A statement about chance is shown, refuted or undecided, never "not significant, so false": its interval
// lies on one side of the bound, on the other, or holds both. A statement that two things are equal comes
// with the margin within which they count as equal, so that it can be shown too. Intervals are 95 % where
// they are printed without a level; `assessed_at` is the level of statements of which many are tested at
// once.
//
// The margins of Chapters 2 to 5 were chosen with results known, and so was the larger number of runs in
// parts of Example 5.4.
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <cstddef>
#include <string>
#include <utility>

#include "incognita/analysis/evaluation/statistics.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita {

inline constexpr double shown_at = usual_confidence, assessed_at = 0.999;

/// Runs that a claim about chance rests on at the least; with fewer its verdict is `undecided`.
inline constexpr int enough_runs = 20;

/// A number of runs, of any integer type.
struct RunCount {
  int value;
  constexpr RunCount(std::integral auto n) : value(static_cast<int>(n)) {}
};

/// What runs say of a statement. Where there is no chance it is shown or refuted, so a bool converts.
class Finding {
 public:
  enum Value { refuted, undecided, shown };
  constexpr Finding(Value value) : value_(value) {}
  constexpr Finding(bool is_shown) : value_(is_shown ? shown : refuted) {}
  friend constexpr bool operator==(Finding, Finding) = default;

  /// Kleene's three-valued logic. Both sides are evaluated.
  friend constexpr Finding operator&&(Finding a, Finding b) { return a.value_ < b.value_ ? a : b; }
  friend constexpr Finding operator||(Finding a, Finding b) { return a.value_ > b.value_ ? a : b; }
  friend constexpr Finding operator!(Finding a) { return Value(shown - a.value_); }

 private:
  Value value_;
};

/// That the quantity is above the bound: the whole interval is (shown), or none of it (refuted).
Finding is_above(const Interval& interval, double bound);
Finding is_below(const Interval& interval, double bound);

/// That the quantity is within `margin` of `value`; margin > 0.
Finding agrees(const Interval& interval, double value, double margin);

/// That the quantity is not exactly `value`: never refuted, as an interval always leaves some difference.
Finding differs(const Interval& interval, double value);

/// That something happens in at least this share of all cases, by Wilson's interval, 95 %; `count` of `of`
/// did.
Finding happens_in(double share, RunCount count, RunCount of);

/// `0.158 m (0.143 to 0.176)`. In place of what is not a number, or of an infinite interval, it says so.
std::string text(const Interval& interval, const std::string& unit = "");

/// With so many digits after the point; `unknown` for what is not finite.
std::string decimals(double x, int digits);

/// What is as good as zero, the same on every processor: the power of ten it stays below, `below 1e-9`; 1e-12
/// at least.
std::string below(double difference);

/// The claim with its verdict. `printed`: what the thesis says; `corrected`: what `why` says instead.
/// - printed shown: holds, and `why` goes, as there is nothing to explain;
/// - printed refuted, corrected shown: holds as corrected;
/// - both refuted: does not hold; without a `why`, that is without a diagnosis, it says "not investigated";
/// - else, or with fewer runs than Claim::least_runs: undecided, and `why` says what was missing.
Claim assessed(Claim claim, Finding printed, Finding corrected = Finding::refuted);

/// A text, or a format with what goes into it: `{"dimension {} of {}", 3, 5}`.
struct Text {
  std::string words;

  Text() = default;
  Text(std::string written) : words(std::move(written)) {}
  Text(const char* written) : words(written) {}
  template <class First, class... Others>
  Text(fmt::format_string<First, Others...> format, First&& first, Others&&... others)
      : words(fmt::format(format, std::forward<First>(first), std::forward<Others>(others)...)) {}
};

/// The members of a Claim that follow its statement.
struct Evidence {
  Text printed = {};
  Text measured;
  Text why = {};
  RunCount runs = 1;    ///< cases, where there is no chance
  RunCount seeds = -1;  ///< random runs, in place of `runs`: the verdict takes `enough_runs` of them
  bool timed = false;
};

/// The claim `id`, which stands at `place` of the thesis.
Claim assessed(std::string id, std::string place, std::string statement, Evidence evidence, Finding printed,
               Finding corrected = Finding::refuted);

}  // namespace incognita
