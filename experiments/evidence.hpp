// From runs to verdicts: how an interval is written, what it shows, and how a claim is assessed.
//
// A statement about chance is shown, refuted or undecided, never "not significant, so false": its interval
// lies on one side of the bound, on the other, or holds both. A statement that two things are equal comes
// with the margin within which they count as equal, so that it can be shown too. All intervals are 95 %.
//
// The margins of Chapters 2 to 5 were chosen with results known, and so was the larger number of runs in
// parts of Example 5.4.
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "incognita/analysis/evaluation/statistics.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita {

/// Runs that a claim about chance rests on at the least; with fewer its finding is `undecided`.
inline constexpr int enough_runs = 20;

/// A number of runs, of any integer type.
struct RunCount {
  int value;
  constexpr RunCount(std::integral auto n) : value(static_cast<int>(n)) {}
};

/// What runs say of a statement. Where there is no chance it is shown or refuted, so a bool converts.
class Answer {
 public:
  enum Value { refuted, undecided, shown };
  constexpr Answer(Value value) : value_(value) {}
  constexpr Answer(bool is_shown) : value_(is_shown ? shown : refuted) {}
  friend constexpr bool operator==(Answer, Answer) = default;

  /// Kleene's three-valued logic. Both sides are evaluated.
  friend constexpr Answer operator&&(Answer a, Answer b) { return a.value_ < b.value_ ? a : b; }
  friend constexpr Answer operator||(Answer a, Answer b) { return a.value_ > b.value_ ? a : b; }
  friend constexpr Answer operator!(Answer a) { return Value(shown - a.value_); }

 private:
  Value value_;
};

/// That the quantity is above the bound: the whole interval is (shown), or none of it (refuted).
Answer is_above(const Interval& interval, double bound);
Answer is_below(const Interval& interval, double bound);

/// That the quantity is within `margin` of `value`; margin > 0.
Answer agrees(const Interval& interval, double value, double margin);

/// That a mean NEES over its degrees of freedom is 1: the one margin of consistency, in all chapters.
inline constexpr double nees_margin = 0.2;
inline Answer is_consistent(const Interval& nees) { return agrees(nees, 1, nees_margin); }

/// That the quantity is not exactly `value`: never refuted, as an interval always leaves some difference.
Answer differs(const Interval& interval, double value);

/// That something happens in at least this share of all cases, by Wilson's interval, 95 %; `count` of `of`
/// did.
Answer happens_in(double share, RunCount count, RunCount of);

/// `0.158 m (0.143 to 0.176)`. In place of what is not a number, or of an infinite interval, it says so.
std::string text(const Interval& interval, const std::string& unit = "");

/// With so many digits after the point; `unknown` for what is not finite.
std::string decimals(double x, int digits);

/// What is as good as zero, the same on every processor: the power of ten it stays below, `below 1e-9`; 1e-12
/// at least.
std::string below(double difference);

/// What was tested in place of a printed statement that is refuted, with the answer. `why` says it in words.
struct Instead {
  Finding found;  ///< when it is shown and the printed statement refuted
  Answer answer;
};

/// The form that is meant, with the slip of the printed one put right.
inline Instead as_corrected(Answer answer) { return {Finding::misprint, answer}; }
/// The printed statement under a condition that the thesis does not state.
inline Instead on_condition(Answer answer) { return {Finding::holds_if, answer}; }
/// What is true and contradicts the printed statement: it does not hold, and the reason is tested.
inline Instead in_truth(Answer answer) { return {Finding::does_not_hold, answer}; }

/// The claim with its finding. `printed`: what the thesis says; `instead`: what `why` says.
/// - printed shown: holds, and `why` goes, as there is nothing to explain;
/// - printed refuted, `instead` shown: what `instead` is;
/// - both refuted: does not hold, "not investigated": no `why` that was not shown is printed;
/// - printed refuted, in_truth() left open: does not hold, and the reason is not known;
/// - else, or with fewer runs than Claim::least_runs: undecided, and `why` says what was missing.
/// The source comes from the quotations (quotations.hpp), by the claim's id.
Claim assessed(Claim claim, Answer printed, Instead instead = in_truth(Answer::refuted));

/// Chapter 4: the same claim by the method of the thesis; the finding of `claim` is what is true.
Claim by_the_method(Claim claim, Answer printed, Instead instead = in_truth(Answer::refuted));

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
  Rule rule = Rule::identity;
  Text printed = {};
  Text measured;
  std::optional<ClaimNumber> number = {};  ///< that the claim is cited by
  Text why = {};
  RunCount runs = 1;    ///< cases, where there is no chance
  RunCount seeds = -1;  ///< random runs, in place of `runs`: the finding takes `enough_runs` of them
  bool timed = false;
};

/// The claim `id`, which stands at `place` of the thesis.
Claim assessed(std::string id, std::string place, std::string statement, Evidence evidence, Answer printed,
               Instead instead = in_truth(Answer::refuted));

/// A number without chance.
inline ClaimNumber exactly(std::string what, double value, std::string unit = "") {
  return {std::move(what), {value, value, value}, std::move(unit)};
}

}  // namespace incognita
