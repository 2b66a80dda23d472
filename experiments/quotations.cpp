#include "experiments/quotations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

namespace incognita {
namespace {

struct ListedSection {
  std::string_view section;
  std::string_view pages;
};

/// From the table of contents: a section ends on the page before the next one begins, or on that page.
constexpr ListedSection table_of_contents[] = {
    {"Abstract", "ii-iii"}, {"1", "1-2"},         {"1.1", "2-5"},       {"1.2", "5-6"},
    {"1.3", "6-8"},         {"1.4", "8-10"},      {"2", "11"},          {"2.1", "11-13"},
    {"2.2", "13-14"},       {"2.2.1", "14-16"},   {"2.2.2", "16-17"},   {"2.2.3", "17-20"},
    {"2.2.4", "20-21"},     {"2.2.5", "21-27"},   {"2.3", "27-28"},     {"2.3.1", "28-32"},
    {"2.3.2", "32-35"},     {"2.4", "35-38"},     {"3", "39-42"},       {"3.1", "42-51"},
    {"3.2", "51-59"},       {"3.3", "59-68"},     {"3.4", "68-70"},     {"3.5", "70-72"},
    {"4", "73-76"},         {"4.1", "76-78"},     {"4.1.1", "78-87"},   {"4.1.2", "87-94"},
    {"4.1.3", "94-99"},     {"4.1.4", "99-102"},  {"4.2", "102-106"},   {"4.3", "106-110"},
    {"4.4", "110-112"},     {"5", "113-115"},     {"5.1", "115-118"},   {"5.2", "118-123"},
    {"5.2.1", "123-125"},   {"5.2.2", "125-133"}, {"5.3", "133-134"},   {"6", "135-138"},
    {"6.1", "138"},         {"6.1.1", "138-141"}, {"6.1.2", "141-142"}, {"6.2", "142-143"},
    {"6.3", "143-144"},     {"6.3.1", "144-150"}, {"6.3.2", "150-153"}, {"6.4", "153"},
    {"6.4.1", "153-154"},   {"6.4.2", "154-159"}, {"6.4.3", "159-164"}, {"6.5", "164-165"},
    {"7", "167"},           {"7.1", "167-169"},   {"7.2", "169-170"},   {"7.3", "170-172"},
    {"A.1", "173-175"},     {"A.2", "175-177"},   {"B", "179-182"},     {"C.1", "183-185"},
    {"C.2", "185-186"},     {"C.3", "186-188"},   {"C.4", "188-189"}};

std::map<std::string_view, Quotation> by_claim() {
  std::map<std::string_view, Quotation> all;
  for (const auto& chapter : {quotations_of_chapters_1_to_3(), quotations_of_chapter_4(),
                              quotations_of_chapter_5(), quotations_of_chapter_6()})
    for (const Quotation& q : chapter)
      if (!all.emplace(q.claim, q).second)
        throw std::logic_error(fmt::format("quotations: two for the claim `{}`", q.claim));
  return all;
}

}  // namespace

std::string pages_of(std::string_view section) {
  const auto found = std::ranges::find(table_of_contents, section, &ListedSection::section);
  return found == std::end(table_of_contents) ? "" : std::string(found->pages);
}

std::optional<ClaimSource> source_of(std::string_view claim) {
  static const std::map<std::string_view, Quotation> all = by_claim();
  const auto found = all.find(claim);
  if (found == all.end()) return std::nullopt;
  const Quotation& q = found->second;
  return ClaimSource{std::string(q.section), pages_of(q.section), std::string(q.words)};
}

}  // namespace incognita
