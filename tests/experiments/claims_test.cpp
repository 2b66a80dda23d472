// The published ledger, docs/ledger/claims.json, is what the experiments find: every experiment is run again, and each of
// its claims must be there with the same statement, finding, reason and number, and none besides. Numbers are compared to
// the three digits with which the page prints them, as their last digits may differ between processors; the measured text
// is not compared, nor are the finding and the number of a timed claim.
//
// An experiment that takes too long with all its runs is run with few: its findings are then guarded by the numbers that
// the claims are cited by, each of which must be possible after the few. With INCOGNITA_ALL_RUNS=1 in the environment
// these are run completely, too, which takes hours.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <string_view>

#include "experiments/quotations.hpp"
#include "incognita/report/experiment.hpp"
#include "tests/scratch.hpp"

namespace incognita {

/// GoogleTest names a case by this.
void PrintTo(const Experiment& experiment, std::ostream* out) { *out << experiment.id; }

namespace {

constexpr int few_runs = 10;  // of which those of Chapter 6 take half

bool all_runs() {
  const char* const wanted = std::getenv("INCOGNITA_ALL_RUNS");
  return wanted && std::string_view(wanted) == "1";
}

const std::vector<LedgerEntry>& published() {
  static const std::vector<LedgerEntry> all = read_ledger(
      testing::contents(INCOGNITA_SOURCE_DIR "/docs/ledger/claims.json"), "docs/ledger/claims.json");
  return all;
}

/// Claims of the published entry by their ids.
std::map<std::string, Claim> published_claims(const std::string& entry) {
  std::map<std::string, Claim> claims;
  for (const LedgerEntry& e : published())
    if (e.id == entry)
      for (const Claim& claim : e.claims) claims.emplace(claim.id, claim);
  return claims;
}

/// No `inf` and no `nan` as a number in the text for readers.
void expect_finite_numbers(const LedgerEntry& entry) {
  static const std::regex not_a_number("(^|[^A-Za-z])(inf|nan)([^A-Za-z]|$)");
  for (const Claim& claim : entry.claims)
    for (const std::string& text : {claim.statement, claim.measured, claim.why})
      EXPECT_FALSE(std::regex_search(text, not_a_number)) << claim.id << ": " << text;
}

/// Of claims about chance that rest on fewer runs than they take.
void expect_undecided_with_few_runs(const LedgerEntry& entry) {
  for (const Claim& claim : entry.claims)
    if (claim.runs < claim.least_runs) {
      EXPECT_EQ(claim.finding, Finding::undecided) << claim.id;
    }
}

void expect_same_statement(const Claim& now, const Claim& then) {
  EXPECT_EQ(now.statement, then.statement) << now.id;
  EXPECT_EQ(now.place, then.place) << now.id;
  EXPECT_EQ(now.printed, then.printed) << now.id;
  EXPECT_EQ(now.source.has_value(), then.source.has_value()) << now.id;
  if (now.source && then.source) EXPECT_EQ(now.source->quotation, then.source->quotation) << now.id;
  EXPECT_STREQ(name(now.rule), name(then.rule)) << now.id;
  EXPECT_EQ(now.headline, then.headline) << now.id;
}

void expect_same_finding(const Claim& now, const Claim& then) {
  EXPECT_STREQ(name(now.finding), name(then.finding)) << now.id << ": " << now.measured;
  EXPECT_EQ(now.by_method, then.by_method) << now.id;
  EXPECT_EQ(now.why, then.why) << now.id;
}

/// Printed with three digits, of which the last may be rounded otherwise. Below 1e-9 there is only rounding.
bool same_as_printed(double now, double then) {
  if (!std::isfinite(now) || !std::isfinite(then)) return std::isfinite(now) == std::isfinite(then);
  if (std::max(std::abs(now), std::abs(then)) < 1e-9) return true;
  const double third_digit = std::pow(10, std::floor(std::log10(std::abs(then))) - 2);
  return std::abs(now - then) <= third_digit;
}

void expect_same_number(const Claim& now, const Claim& then) {
  ASSERT_EQ(now.number.has_value(), then.number.has_value()) << now.id;
  if (!now.number) return;
  EXPECT_EQ(now.number->what, then.number->what) << now.id;
  EXPECT_EQ(now.number->unit, then.number->unit) << now.id;
  const Interval &is = now.number->value, &was = then.number->value;
  EXPECT_TRUE(same_as_printed(is.value, was.value) && same_as_printed(is.low, was.low) &&
              same_as_printed(is.high, was.high))
      << now.id << ": published " << was.value << " (" << was.low << " to " << was.high << "), now "
      << is.value << " (" << is.low << " to " << is.high << ")";
}

/// What a number may be after few runs if the published one is right, at 99.9 %: by the spread of the few (Student's t of
/// five runs), or by that of the published runs, whichever is wider, since a few runs that happen to agree show none.
/// It is for a code that changed and not for chance that this is to fail.
Interval possible_after(const Claim& few, const Claim& all) {
  constexpr double t_ratio = 8.610 / 2.776, normal_ratio = 3.29 / 1.96;
  const Interval &now = few.number->value, &then = all.number->value;
  const double more = normal_ratio * std::sqrt(static_cast<double>(all.runs) / few.runs);
  return {now.value, now.value - std::max(t_ratio * (now.value - now.low), more * (then.high - then.value)),
          now.value + std::max(t_ratio * (now.high - now.value), more * (then.value - then.low))};
}

void expect_published_number_possible(const Claim& now, const Claim& then) {
  if (!now.number || !then.number) return;
  // After few runs a claim with several rivals may turn on another one: then there is nothing to compare
  if (now.number->what != then.number->what) return;
  const Interval possible = possible_after(now, then);
  if (std::isnan(possible.value)) return;  // e.g. the mean over runs of which these few have none
  EXPECT_TRUE(possible.contains(then.number->value.value))
      << now.id << ": published " << then.number->value.value << ", now " << possible.value
      << ", which may be from " << possible.low << " to " << possible.high;
}

class Claims : public ::testing::TestWithParam<Experiment> {};

/// Of a costly experiment by what the number may be where the two have not the same runs.
void expect_same_result(const Claim& now, const Claim& then, bool costly, bool few) {
  if (now.timed) return;
  if (costly && (few || now.runs != then.runs)) {
    expect_published_number_possible(now, then);
  } else {
    EXPECT_EQ(now.runs, then.runs) << now.id;
    expect_same_finding(now, then);
    expect_same_number(now, then);
  }
}

TEST_P(Claims, ArePublishedWithTheirFindings) {
  const testing::Scratch scratch;
  ExperimentSettings settings;
  settings.out = scratch.folder();
  const bool few = GetParam().costly && !all_runs();
  if (few) settings.seeds = few_runs;
  const LedgerEntry entry = GetParam().run(settings);
  if (!entry.skipped.empty()) GTEST_SKIP() << entry.skipped;
  EXPECT_FALSE(entry.claims.empty());
  expect_finite_numbers(entry);
  std::map<std::string, Claim> then = published_claims(entry.id);
  expect_undecided_with_few_runs(entry);
  for (const Claim& claim : entry.claims) {
    const auto found = then.find(claim.id);
    if (found == then.end()) {
      ADD_FAILURE() << "docs/ledger/claims.json lacks " << claim.id << ": see docs/add-an-experiment.md";
      continue;
    }
    expect_same_statement(claim, found->second);
    expect_same_result(claim, found->second, GetParam().costly, few);
    then.erase(found);
  }
  for (const auto& [id, claim] : then)
    ADD_FAILURE() << "docs/ledger/claims.json has " << id << ", which no experiment finds any more";
}

/// After a single run statistical claims are undecided, and all written numbers are finite. Costly experiments
/// are run only once, with few runs, by the test above.
TEST_P(Claims, StatisticalOnesAreUndecidedAfterOneRun) {
  const std::string& id = GetParam().id;
  if (id.starts_with("4.")) return;  // the examples of Chapter 4 have no statistical claims
  if (GetParam().costly) return;
  const testing::Scratch scratch;
  ExperimentSettings settings;
  settings.out = scratch.folder();
  settings.seeds = 1;
  const LedgerEntry entry = GetParam().run(settings);
  expect_finite_numbers(entry);
  expect_undecided_with_few_runs(entry);
}

std::string name_of(const ::testing::TestParamInfo<Experiment>& info) {
  std::string name;
  for (const char c : info.param.id) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Ledger, Claims, ::testing::ValuesIn(all_experiments()), name_of);

TEST(PublishedLedger, HasAllExperimentsAndEachClaimOnce) {
  std::set<std::string> entries, claims;
  for (const LedgerEntry& entry : published()) {
    EXPECT_TRUE(entries.insert(entry.id).second) << entry.id;
    for (const Claim& claim : entry.claims) EXPECT_TRUE(claims.insert(claim.id).second) << claim.id;
  }
  for (const Experiment& experiment : all_experiments())
    EXPECT_TRUE(entries.contains(experiment.id)) << experiment.id;
}

TEST(PublishedLedger, ClaimsOfTheThesisHaveAPlaceInIt) {
  for (const LedgerEntry& entry : published())
    for (const Claim& claim : entry.claims)
      if (claim.source) {
        EXPECT_NE(claim.source->pages, "") << claim.id << ": no section " << claim.source->section;
        EXPECT_NE(claim.source->quotation, "") << claim.id;
      }
}

TEST(PublishedLedger, ThePageIsMadeOfIt) {
  EXPECT_TRUE(testing::contents(INCOGNITA_SOURCE_DIR "/docs/claims.md") == ledger_markdown(published()))
      << "docs/claims.md is not the page of docs/ledger/claims.json: see docs/add-an-experiment.md";
}

TEST(PublishedLedger, HasTenHeadlines) {
  int headlines = 0;
  for (const LedgerEntry& entry : published())
    for (const Claim& claim : entry.claims) headlines += !claim.headline.empty();
  EXPECT_EQ(headlines, 10);
}

TEST(Quotations, AreOfClaims) {
  std::set<std::string> ids;
  for (const LedgerEntry& entry : published())
    for (const Claim& claim : entry.claims) ids.insert(claim.id);
  for (const auto& chapter : {quotations_of_chapters_1_to_3(), quotations_of_chapter_4(),
                              quotations_of_chapter_5(), quotations_of_chapter_6()})
    for (const Quotation& q : chapter) {
      EXPECT_TRUE(ids.contains(std::string(q.claim))) << q.claim;
      EXPECT_NE(pages_of(q.section), "") << q.claim << ": no section " << q.section;
    }
}

}  // namespace
}  // namespace incognita
