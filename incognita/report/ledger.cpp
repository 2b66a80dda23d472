#include "incognita/report/ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

constexpr Verdict verdicts[] = {Verdict::holds, Verdict::holds_as_corrected, Verdict::does_not_hold,
                                Verdict::undecided};

Json json_of(const Claim& claim) {
  return {{"id", claim.id},           {"place", claim.place},       {"statement", claim.statement},
          {"printed", claim.printed}, {"measured", claim.measured}, {"verdict", name(claim.verdict)},
          {"why", claim.why},         {"runs", claim.runs},         {"least_runs", claim.least_runs}};
}

Json json_of(const LedgerEntry& entry) {
  Json json{{"id", entry.id}, {"title", entry.title}};
  if (!entry.skipped.empty()) json["skipped"] = entry.skipped;
  json["claims"] = Json::array();
  for (const Claim& claim : entry.claims) json["claims"].push_back(json_of(claim));
  json["figures"] = Json::array();
  for (const LedgerFigure& figure : entry.figures)
    json["figures"].push_back({{"id", figure.id}, {"file", figure.file}, {"data", figure.data}});
  return json;
}

/// Escapes text for one line of Markdown, in a table or not.
std::string plain(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '*' || c == '`' || c == '<') escaped += '\\';
    escaped += c == '\n' || c == '\r' ? ' ' : c;
  }
  return escaped;
}

/// E.g. `holds as corrected`.
std::string in_words(Verdict verdict) {
  std::string words = name(verdict);
  std::replace(words.begin(), words.end(), '-', ' ');
  return words;
}

std::size_t count(const std::vector<LedgerEntry>& entries, Verdict verdict) {
  std::size_t found = 0;
  for (const LedgerEntry& entry : entries)
    found += static_cast<std::size_t>(std::count_if(entry.claims.begin(), entry.claims.end(),
                                                    [=](const Claim& c) { return c.verdict == verdict; }));
  return found;
}

std::string section(const LedgerEntry& entry) {
  std::string text = fmt::format("\n## {}: {}\n", plain(entry.id), plain(entry.title));
  if (!entry.skipped.empty()) text += fmt::format("\nSkipped: {}\n", plain(entry.skipped));
  if (!entry.claims.empty())
    text += "\n| place | statement | printed | measured | verdict | why |\n|---|---|---|---|---|---|\n";
  for (const Claim& claim : entry.claims)
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} |\n", plain(claim.place), plain(claim.statement),
                    plain(claim.printed), plain(claim.measured), in_words(claim.verdict), plain(claim.why));
  std::vector<std::string> figures;
  for (const LedgerFigure& figure : entry.figures) figures.push_back(fmt::format("`{}`", figure.file));
  if (!figures.empty()) text += fmt::format("\nFigures: {}\n", fmt::join(figures, ", "));
  return text;
}

}  // namespace

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::holds_as_corrected:
      return "holds-as-corrected";
    case Verdict::does_not_hold:
      return "does-not-hold";
    case Verdict::undecided:
      return "undecided";
  }
  return "unknown";
}

std::string ledger_json(const std::vector<LedgerEntry>& entries) {
  Json document = Json::array();
  for (const LedgerEntry& entry : entries) document.push_back(json_of(entry));
  // Reasons may contain file names that are not UTF-8; a replaced character is better than an exception.
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string ledger_markdown(const std::vector<LedgerEntry>& entries) {
  std::string text =
      "# Claims\n\n"
      "The claims of the thesis, each with the result of its reproduction. A claim holds, holds as corrected, or\n"
      "does not hold; the last column states the reason. It is undecided if the interval of its runs contains\n"
      "both answers, or if there are too few runs. Intervals are 95 % unless another level is given.\n"
      "`incognita reproduce --out DIR` writes this page as `DIR/claims.md`, with every figure and its data.\n\n"
      "| verdict | claims |\n|---|---|\n";
  for (const Verdict verdict : verdicts)
    text += fmt::format("| {} | {} |\n", in_words(verdict), count(entries, verdict));
  const auto skipped =
      std::count_if(entries.begin(), entries.end(), [](const LedgerEntry& e) { return !e.skipped.empty(); });
  if (skipped > 0) text += fmt::format("| (entries skipped) | {} |\n", skipped);
  for (const LedgerEntry& entry : entries) text += section(entry);
  return text;
}

}  // namespace incognita
