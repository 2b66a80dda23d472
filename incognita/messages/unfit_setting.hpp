// Refusal of settings that do not fit each other, or what they describe.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace incognita {

/// The message states the reason; where the settings were given is for the program to add.
struct UnfitSetting : std::invalid_argument {
  UnfitSetting(std::vector<std::string> of, const std::string& why)
      : std::invalid_argument(why), keys(std::move(of)) {}
  /// "controller.gain_per_s"; the setting to look at first in front. Some may not exist in a scenario, e.g. the radius
  /// of a path without circle.
  std::vector<std::string> keys;
};

}  // namespace incognita
