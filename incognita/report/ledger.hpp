// The claims ledger: each statement of the thesis with the measured result and a verdict.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incognita {

/// `undecided`: the runs do not settle the claim, or there are too few of them.
enum class Verdict { holds, holds_as_corrected, does_not_hold, undecided };
/// The text used in the ledger: `holds`, `holds-as-corrected`, `does-not-hold`, `undecided`.
const char* name(Verdict verdict);

struct Claim {
  std::string id;         ///< unique in the ledger, e.g. `3.1-eigenvalue-one`
  std::string place;      ///< location in the thesis, e.g. `(3.8), Example 3.1`
  std::string statement;  ///< the claim in our words
  std::string printed;    ///< the printed value or formula; may be empty
  std::string measured;   ///< the result with its unit and interval
  Verdict verdict = Verdict::does_not_hold;
  std::string why = {};  ///< the correction, the diagnosis or why it is undecided; empty if it holds
  int runs = 1;          ///< independent runs behind it
  int least_runs = 1;    ///< runs needed for a verdict; 1 for deterministic claims
  bool timed = false;    ///< the verdict depends on timings of this machine: no test may rely on it
};

/// A figure with the data drawn in it.
struct LedgerFigure {
  std::string id;    ///< `fig-3.4`
  std::string file;  ///< SVG, relative to the output folder
  std::string data;  ///< CSV, relative to the output folder
};

struct LedgerEntry {
  std::string id;  ///< `3.1`
  std::string title;
  std::string skipped;  ///< why it was not run, e.g. a missing recording; else empty
  std::vector<Claim> claims;
  std::vector<LedgerFigure> figures;
};

/// The document of `reproduce --json` (docs/schemas/reproduce.schema.json).
std::string ledger_json(const std::vector<LedgerEntry>& entries);

/// The ledger as the page docs/claims.md.
std::string ledger_markdown(const std::vector<LedgerEntry>& entries);

}  // namespace incognita
