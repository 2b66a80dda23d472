// The ledger as the page docs/claims.md: findings first, then counts, rules, errata, and every claim.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <utility>

#include "incognita/report/ledger.hpp"

namespace incognita {
namespace {

using Selects = std::function<bool(const Claim&)>;

constexpr std::array columns{Finding::holds, Finding::misprint, Finding::holds_if, Finding::does_not_hold,
                             Finding::undecided};

/// Escapes text for one line of Markdown, in a table or not.
std::string plain(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '*' || c == '`' || c == '<') escaped += '\\';
    escaped += c == '\n' || c == '\r' ? ' ' : c;
  }
  return escaped;
}

/// E.g. `does not hold`.
std::string in_words(Finding finding) {
  std::string words = name(finding);
  std::replace(words.begin(), words.end(), '-', ' ');
  return words;
}

/// What Claim::why is for a finding.
const char* reason(Finding finding) {
  switch (finding) {
    case Finding::holds:
      return "Remark";
    case Finding::misprint:
      return "Right form";
    case Finding::holds_if:
      return "Condition";
    case Finding::does_not_hold:
      return "In truth";
    case Finding::undecided:
      return "Why undecided";
  }
  return "Why";
}

/// The heading's anchor as GitHub makes it: lower case, without punctuation.
std::string anchor(const std::string& heading) {
  std::string made;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || c == '-' || c == '_') made += static_cast<char>(std::tolower(byte));
    if (c == ' ') made += '-';
  }
  return made;
}

std::string link(const Claim& claim) { return fmt::format("[{}](#{})", claim.id, anchor(claim.id)); }

void for_each_claim(const std::vector<LedgerEntry>& entries, const std::function<void(const Claim&)>& take) {
  for (const LedgerEntry& entry : entries)
    for (const Claim& claim : entry.claims) take(claim);
}

std::string row_of_counts(const std::string& label, const std::vector<LedgerEntry>& entries,
                          const Selects& selects) {
  std::array<int, columns.size()> counts{};
  int all = 0;
  for_each_claim(entries, [&](const Claim& claim) {
    if (!selects(claim)) return;
    ++all;
    for (std::size_t i = 0; i < columns.size(); ++i) counts[i] += claim.finding == columns[i];
  });
  return all == 0 ? "" : fmt::format("| {} | {} | {} |\n", label, fmt::join(counts, " | "), all);
}

/// `Chapter 3` of section 3.1, `Appendix C` of C.2; what is in neither has the section's name.
std::string chapter_of(const Claim& claim) {
  const std::string& section = claim.source->section;
  if (std::isdigit(static_cast<unsigned char>(section.front()))) return "Chapter " + section.substr(0, 1);
  return section.find('.') == 1 ? "Appendix " + section.substr(0, 1) : section;
}

std::vector<std::string> chapters(const std::vector<LedgerEntry>& entries) {
  std::vector<std::string> all;
  for_each_claim(entries, [&](const Claim& claim) {
    if (claim.source && std::ranges::find(all, chapter_of(claim)) == all.end())
      all.push_back(chapter_of(claim));
  });
  const auto place = [](const std::string& chapter) {  // as in the book
    return std::pair(chapter.starts_with("Appendix"), chapter);
  };
  std::ranges::sort(all, {}, place);
  return all;
}

std::string counts(const std::vector<LedgerEntry>& entries) {
  std::string text = "| |";
  for (const Finding finding : columns) text += fmt::format(" {} |", in_words(finding));
  text += " all |\n|---|---:|---:|---:|---:|---:|---:|\n";
  for (const std::string& chapter : chapters(entries))
    text +=
        row_of_counts(chapter, entries, [&](const Claim& c) { return c.source && chapter_of(c) == chapter; });
  text += row_of_counts("the thesis", entries, [](const Claim& c) { return c.source.has_value(); });
  text += row_of_counts("ours", entries, [](const Claim& c) { return !c.source; });
  const auto skipped =
      std::ranges::count_if(entries, [](const LedgerEntry& e) { return !e.skipped.empty(); });
  if (skipped > 0) text += fmt::format("\nEntries skipped: {}.\n", skipped);
  return text;
}

std::string headlines(const std::vector<LedgerEntry>& entries) {
  std::string text;
  int number = 0;
  for_each_claim(entries, [&](const Claim& claim) {
    if (!claim.headline.empty()) text += fmt::format("{}. {} ({})\n", ++number, claim.headline, link(claim));
  });
  return text.empty() ? "" : "\n## Findings\n\n" + text;
}

std::string rules() {
  std::string text =
      "\n## How a claim is decided\n\n"
      "- **holds**: shown as printed.\n"
      "- **misprint**: refuted as printed; the form that is given instead is shown.\n"
      "- **holds if**: refuted as printed; shown under the condition that is given.\n"
      "- **does not hold**: refuted. The diagnosis that is given was tested, or it says \"not investigated\".\n"
      "- **undecided**: the interval contains both answers, or there are too few runs.\n\n"
      "In Chapter 4 a claim about a system has two findings: what is true of the motion itself, and what the method\n"
      "of the thesis, which freezes the measurement within a segment, says. Intervals are 95 % unless another level is given: of the claims\n"
      "that rest on random runs, about one in forty is decided wrongly by chance.\n\n"
      "| rule | a claim of this kind is shown when |\n|---|---|\n";
  for (const Rule rule : all_rules()) text += fmt::format("| {} | {} |\n", name(rule), rule_text(rule));
  return text;
}

std::string errata(const std::vector<LedgerEntry>& entries) {
  std::string text;
  for_each_claim(entries, [&](const Claim& claim) {
    if (claim.finding == Finding::misprint && claim.source)
      text += fmt::format("| {} | {} | {} | {} |\n", plain(claim.place), plain(claim.printed),
                          plain(claim.why), link(claim));
  });
  return text.empty()
             ? ""
             : "\n## Errata of the thesis\n\n| place | printed | right | claim |\n|---|---|---|---|\n" + text;
}

std::string number_text(const ClaimNumber& number) {
  const Interval& i = number.value;
  const std::string unit = number.unit.empty() ? "" : " " + number.unit;
  const std::string range =
      i.low < i.value || i.value < i.high ? fmt::format(" ({:.3g} to {:.3g})", i.low, i.high) : std::string();
  return fmt::format("{}: {:.3g}{}{}", number.what, i.value, unit, range);
}

std::string found(const Claim& claim) {
  const std::string found = in_words(claim.finding);
  return claim.by_method
             ? fmt::format("**{}**; by the method of the thesis: {}", found, in_words(*claim.by_method))
             : fmt::format("**{}**", found);
}

std::string item(const std::string& label, const std::string& text) {
  return text.empty() ? "" : fmt::format("- {}: {}\n", label, plain(text));
}

/// E.g. `Section 3.1`, `Appendix C.3`, `Abstract`
std::string section_name(const std::string& section) {
  if (std::isdigit(static_cast<unsigned char>(section.front())))
    return (section.size() == 1 ? "Chapter " : "Section ") + section;
  return section.size() <= 3 ? "Appendix " + section : section;
}

std::string quoted(const Claim& claim) {
  const ClaimSource& source = *claim.source;
  const char* pages = source.pages.find('-') == std::string::npos ? "p." : "pp.";
  return fmt::format("> {} ({}; {}, {} {})\n\n", plain(source.quotation), plain(claim.place),
                     section_name(source.section), pages, source.pages);
}

std::string block(const Claim& claim) {
  std::string text = fmt::format("\n### {}\n\n", claim.id);
  text += claim.source ? quoted(claim) : fmt::format("Ours, beside {}.\n\n", plain(claim.place));
  text += fmt::format("{}\n\n- Finding: {}\n", plain(claim.statement), found(claim));
  text += item("Number", claim.number ? number_text(*claim.number) : "");
  text += item("Printed", claim.printed) + item("Measured", claim.measured) +
          item(reason(claim.finding), claim.why);
  return text +
         fmt::format("- Rule: {}; {} {}\n", name(claim.rule), claim.runs, claim.runs == 1 ? "run" : "runs");
}

std::string section(const LedgerEntry& entry) {
  std::string text = fmt::format("\n## {}: {}\n", plain(entry.id), plain(entry.title));
  if (!entry.skipped.empty()) text += fmt::format("\nSkipped: {}\n", plain(entry.skipped));
  std::vector<std::string> figures;
  for (const LedgerFigure& figure : entry.figures) figures.push_back(figure.id);
  text += fmt::format("\nRun again: `incognita reproduce {}`.{}\n", entry.id,
                      figures.empty() ? "" : fmt::format(" Figures: {}.", fmt::join(figures, ", ")));
  for (const Claim& claim : entry.claims) text += block(claim);
  return text;
}

}  // namespace

std::string ledger_markdown(const std::vector<LedgerEntry>& entries) {
  std::string text =
      "# Claims\n\n"
      "The claims of the thesis, and ours beside them, each with its reproduction. `incognita reproduce --out DIR`\n"
      "writes this page as `DIR/claims.md`, with every figure and its data.\n\n" +
      counts(entries) + headlines(entries) + rules() + errata(entries);
  for (const LedgerEntry& entry : entries) text += section(entry);
  return text;
}

}  // namespace incognita
