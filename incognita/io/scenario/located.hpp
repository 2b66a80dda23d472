// Refusals of settings with the place where each was given.
#pragma once

#include <string>

#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/messages/unfit_setting.hpp"

namespace incognita {

/// "mine.toml:7: controller.gain_per_s = [50.0]: must ...; here run.rate_hz = 10.0 (default)". A setting of the command
/// line comes first, then those of the file.
std::string located(const LoadedScenario& loaded, const UnfitSetting& unfit);

/// The reason behind the source of the setting whose key it starts with, or else behind the name of the file.
std::string located(const LoadedScenario& loaded, const std::string& why);

}  // namespace incognita
