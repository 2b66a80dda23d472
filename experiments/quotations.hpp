// Where the thesis makes each claim, in its own words. A claim without a quotation is ours.
//
// The text of the thesis that the quotations are from has no page numbers; pages are those of the section, by
// the table of contents.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "incognita/report/ledger.hpp"

namespace incognita {

struct Quotation {
  std::string_view claim;    ///< its id
  std::string_view section;  ///< `3.1`, `Abstract`
  std::string_view words;    ///< verbatim; `[...]` where something is left out
};

// Each chapter's are in a file of their own.
std::span<const Quotation> quotations_of_chapters_1_to_3();
std::span<const Quotation> quotations_of_chapter_4();
std::span<const Quotation> quotations_of_chapter_5();
std::span<const Quotation> quotations_of_chapter_6();

/// Of the claim with this id; none where the thesis does not make it.
std::optional<ClaimSource> source_of(std::string_view claim);

/// Pages of a section, `42-50`; empty if there is none of that name.
std::string pages_of(std::string_view section);

}  // namespace incognita
