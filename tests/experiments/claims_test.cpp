// docs/claims.md is up to date: every experiment is run again, and each of its claims must be there with the
// same verdict. Measured values may differ in their last digits between processors and are not compared; nor
// is the verdict of a timed claim, or of one that takes too long with all its seeds.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "incognita/report/experiment.hpp"
#include "tests/scratch.hpp"

namespace incognita {

/// GoogleTest names a case by this.
void PrintTo(const Experiment& experiment, std::ostream* out) { *out << experiment.id; }

namespace {

/// The cells of a row that are compared: place, statement, printed and, unless it is timed, verdict and why.
/// The fourth cell, measured, is not compared.
enum class Cells { all, of_the_thesis };

std::set<std::string> rows_of(const std::string& page, Cells cells_compared) {
  std::set<std::string> rows;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| ", 0) != 0) continue;
    std::vector<std::string> cells(1);
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '|' && (i == 0 || line[i - 1] != '\\'))
        cells.emplace_back();
      else
        cells.back() += line[i];
    }
    if (cells.size() < 7) continue;
    std::string row = cells[1] + "|" + cells[2] + "|" + cells[3];
    if (cells_compared == Cells::all) row += "|" + cells[5] + "|" + cells[6];
    rows.insert(row);
  }
  return rows;
}

std::string published() {
  std::ostringstream text;
  text << std::ifstream(INCOGNITA_SOURCE_DIR "/docs/claims.md").rdbuf();
  return text.str();
}

/// No `inf` and no `nan` as a number in the text for readers.
void expect_finite_numbers(const LedgerEntry& entry) {
  static const std::regex not_a_number("(^|[^A-Za-z])(inf|nan)([^A-Za-z]|$)");
  for (const Claim& claim : entry.claims)
    for (const std::string& cell : {claim.statement, claim.measured, claim.why})
      EXPECT_FALSE(std::regex_search(cell, not_a_number)) << claim.id << ": " << cell;
}

/// Of claims about chance that rest on fewer runs than they take.
void expect_undecided_with_few_runs(const LedgerEntry& entry) {
  for (const Claim& claim : entry.claims)
    if (claim.least_runs > 1) {
      EXPECT_EQ(claim.verdict == Verdict::undecided, claim.runs < claim.least_runs) << claim.id;
    }
}

class Claims : public ::testing::TestWithParam<Experiment> {};

TEST_P(Claims, ArePublishedWithTheirVerdicts) {
  const testing::Scratch scratch;
  ExperimentSettings settings;
  settings.out = scratch.folder();
  if (GetParam().costly) settings.seeds = 4;
  const LedgerEntry entry = GetParam().run(settings);
  if (!entry.skipped.empty()) GTEST_SKIP() << entry.skipped;
  EXPECT_FALSE(entry.claims.empty());
  expect_finite_numbers(entry);
  if (GetParam().costly) expect_undecided_with_few_runs(entry);
  for (const Claim& claim : entry.claims) {
    const Cells compared = claim.timed || GetParam().costly ? Cells::of_the_thesis : Cells::all;
    LedgerEntry alone = entry;
    alone.claims = {claim};
    const std::set<std::string> page = rows_of(published(), compared);
    for (const std::string& row : rows_of(ledger_markdown({alone}), compared))
      EXPECT_TRUE(page.count(row)) << "docs/claims.md lacks\n"
                                   << row << "\n`incognita reproduce` writes the page again";
  }
}

/// After a single run statistical claims are undecided, and all written numbers are finite. Costly experiments
/// are run only once, with few runs, by the test above.
TEST_P(Claims, StatisticalOnesAreUndecidedAfterOneRun) {
  const std::string& id = GetParam().id;
  if (id.starts_with("4.") || id == "text-4") return;  // Chapter 4 has no statistical claims
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

}  // namespace
}  // namespace incognita
