// The findings that stand on the first screen of the ledger: one sentence each.
#pragma once

#include <string>
#include <string_view>

namespace incognita {

/// The sentence for the claim with this id; empty for most.
std::string headline_of(std::string_view claim);

}  // namespace incognita
