// The claims ledger: each statement of the thesis, and of ours beside it, with the measured result, how it was
// decided and what was found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/evaluation/statistics.hpp"

namespace incognita {

/// What the reproduction found of a claim.
/// - misprint: what is meant is true, the printed form has a slip; Claim::why gives the right form
/// - holds_if: true under a condition that the thesis does not state; Claim::why states it
/// - undecided: the runs do not settle it, or there are too few of them
enum class Finding { holds, misprint, holds_if, does_not_hold, undecided };
/// `holds`, `misprint`, `holds-if`, `does-not-hold`, `undecided`.
const char* name(Finding finding);

/// The coarser classification of earlier ledgers: misprint and holds_if are `holds-as-corrected`.
/// `holds`, `holds-as-corrected`, `does-not-hold`, `undecided`.
const char* verdict(Finding finding);

/// The rule that decides a kind of claim; `rule_text` says how.
enum class Rule {
  identity,     ///< two expressions are equal
  dimension,    ///< a rank, or the dimension of a null space
  example,      ///< one case shows it, or one refutes it
  superiority,  ///< more or less of something than another method or a bound
  equality,     ///< two quantities are equal, within a margin
  coverage,     ///< errors are inside their 2 sigma bounds
  boundedness,  ///< something does not grow any more
  frequency,    ///< something happens in at least a share of the cases
};
const std::vector<Rule>& all_rules();
const char* name(Rule rule);       ///< `identity`, ...
const char* rule_text(Rule rule);  ///< a sentence for the page

/// Where the thesis says it.
struct ClaimSource {
  std::string section;    ///< `3.1`, `Abstract`
  std::string pages;      ///< of the section, by the table of contents: `42-50`
  std::string quotation;  ///< the thesis' own words
};

/// The number that a claim is cited by.
struct ClaimNumber {
  std::string what;
  Interval value;  ///< low = high = value without chance
  std::string unit = {};
};

struct Claim {
  std::string id;         ///< unique in the ledger, e.g. `3.1-eigenvalue-one`
  std::string place;      ///< location in the thesis, e.g. `(3.8), Example 3.1`
  std::string statement;  ///< the claim in our words
  std::string printed;    ///< the printed value or formula; may be empty
  std::string measured;   ///< the result with its unit and interval
  Finding finding = Finding::does_not_hold;
  std::string why = {};  ///< the correction, the diagnosis or why it is undecided; empty if it holds
  int runs = 1;          ///< independent runs behind it
  int least_runs = 1;    ///< runs needed for a finding; 1 for deterministic claims
  bool timed = false;    ///< the finding depends on timings of this machine: no test may rely on it
  Rule rule = Rule::identity;
  std::optional<ClaimNumber> number = {};
  std::optional<ClaimSource> source = {};  ///< none: a claim of ours
  std::optional<Finding> by_method = {};  ///< Chapter 4: what the thesis' method says; `finding` is the truth
  std::string headline = {};              ///< one sentence, for those on the first screen
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

/// What ledger_json() wrote. `name`: of the file, for messages. Throws InputError for anything else.
std::vector<LedgerEntry> read_ledger(const std::string& document, const std::string& name);

/// The ledger as the page docs/claims.md.
std::string ledger_markdown(const std::vector<LedgerEntry>& entries);

}  // namespace incognita
