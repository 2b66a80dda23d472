// docs/claims.md says what comes out: every experiment is run again, and each of its claims must stand there
// with the same verdict. What was measured may differ in its last digits from one processor to the next and
// is not compared; nor is the verdict of what is timed, or of what takes too long to be run with all its
// seeds here.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "experiments/experiment.hpp"
#include "tests/scratch.hpp"

namespace incognita {

/// GoogleTest names a case after this.
void PrintTo(const Experiment& experiment, std::ostream* out) { *out << experiment.id; }

namespace {

/// What of a row is compared: place, statement, printed and, unless it is timed, verdict and why. What was
/// measured, the fourth cell, is not.
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

class Claims : public ::testing::TestWithParam<Experiment> {};

TEST_P(Claims, ArePublishedAsTheyComeOut) {
  const testing::Scratch scratch;
  ExperimentSettings settings;
  settings.out = scratch.folder();
  if (GetParam().costly) settings.seeds = 4;
  const LedgerEntry entry = GetParam().run(settings);
  if (!entry.skipped.empty()) GTEST_SKIP() << entry.skipped;
  EXPECT_FALSE(entry.claims.empty());
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

std::string name_of(const ::testing::TestParamInfo<Experiment>& info) {
  std::string name;
  for (const char c : info.param.id) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Ledger, Claims, ::testing::ValuesIn(all_experiments()), name_of);

}  // namespace
}  // namespace incognita
