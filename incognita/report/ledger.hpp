// The claims ledger: what the thesis says, what came out, and whether it holds.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incognita {

/// `undecided`: the runs leave both answers open, or there are too few of them.
enum class Verdict { holds, holds_as_corrected, does_not_hold, undecided };
/// As the ledger writes it: `holds`, `holds-as-corrected`, `does-not-hold`, `undecided`.
const char* name(Verdict verdict);

struct Claim {
  std::string id;         ///< unique in the ledger, e.g. `3.1-eigenvalue-one`
  std::string place;      ///< where the thesis says it, e.g. `(3.8), Example 3.1`
  std::string statement;  ///< what it says, in our words
  std::string printed;    ///< the printed value or formula; empty where there is none
  std::string measured;   ///< what came out, with its unit and interval
  Verdict verdict = Verdict::does_not_hold;
  std::string why;     ///< the correction, the diagnosis, or why it is undecided; empty where it holds
  int runs = 1;        ///< independent runs it rests on
  int least_runs = 1;  ///< runs without which it is undecided; 1 where there is no chance
  bool timed = false;  ///< its verdict is of this machine and this moment: no test may rest on it
};

/// A picture with the numbers that are drawn in it.
struct LedgerFigure {
  std::string id;    ///< `fig-3.4`
  std::string file;  ///< SVG, relative to the output folder
  std::string data;  ///< CSV, relative to the output folder
};

struct LedgerEntry {
  std::string id;  ///< `3.1`
  std::string title;
  std::string skipped;  ///< why nothing was done, e.g. that a recording is missing; else empty
  std::vector<Claim> claims;
  std::vector<LedgerFigure> figures;
};

/// The document of `reproduce --json` (docs/schemas/reproduce.schema.json).
std::string ledger_json(const std::vector<LedgerEntry>& entries);

/// The same as a page for people: docs/claims.md.
std::string ledger_markdown(const std::vector<LedgerEntry>& entries);

}  // namespace incognita
