// The name a person probably meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace incognita {

/// Letters to insert, delete, replace or swap with their neighbour to get from one name to the other.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate with the fewest edits; the first of equals; empty when there are no candidates.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace incognita
