// Spelling suggestions for unknown names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace incognita {

/// Insertions, deletions, substitutions and swaps of adjacent letters that turn one name into the other.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate at the smallest edit distance, the first one in a tie; empty without candidates.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace incognita
