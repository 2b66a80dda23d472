// Settings that were renamed: docs/changes.md.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace incognita {

struct RenamedSetting {
  const char* before;
  const char* after;  ///< one of the new keys, if a setting became several
};

std::span<const RenamedSetting> renamed_settings();

/// {"path.type"}, or {"path.center_m", "path.position_m"}; empty for a key that was never in use.
std::vector<std::string> new_keys(const std::string& key);

/// The sections that have the settings of a former section now: {"landmark_initialization"} of "birth".
std::vector<std::string> new_sections(const std::string& section);

}  // namespace incognita
