// Settings that were renamed: docs/changes.md.
#pragma once

#include <span>
#include <string>

namespace incognita {

struct RenamedSetting {
  const char* before;
  const char* after;  ///< one of the new keys, if a setting became several
};

std::span<const RenamedSetting> renamed_settings();

/// "`path.type`", or "`path.center_m` or `path.position_m`"; empty for a key that was never in use.
std::string new_key(const std::string& key);

}  // namespace incognita
