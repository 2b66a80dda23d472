// A setting: a key bound to a field of a scenario, with unit and allowed values.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "incognita/decision/settings.hpp"
#include "incognita/io/formats/toml_value.hpp"
#include "incognita/slam/features/settings.hpp"

namespace incognita {

/// The allowed values of a setting.
struct Allowed {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool more_than_least = false;  ///< `least` itself is excluded
  bool odd = false;
  std::vector<std::string> choices;  ///< of a string; empty: any

  /// "0 to 1", "more than 0", "`room` or `recording`"; empty if unrestricted.
  std::string text() const;
};

struct Setting {
  std::string key;  ///< "section.name"; the name ends with the unit
  std::variant<std::string*, int*, std::int64_t*, double*, Eigen::Vector3d*, bool*, Eigen::Vector2d*,
               std::vector<Eigen::Vector2d>*, std::vector<Eigen::Vector3d>*, std::vector<double>*,
               DecisionSettings::Strategy*, Metric*, DecisionSettings::Schedule*, DecisionSettings::Gaze*,
               ExplorationSettings::Counted*, InitializationSettings::Method*,
               InitializationSettings::Center*, StartSettings::From*>
      field;
  std::string unit;  ///< empty for counts, ratios and strings
  std::string help;
  Allowed allowed;

  /// The current value in TOML.
  std::string written() const;
  /// "a text", "a whole number", ...
  std::string kind() const;
};

/// Why a value was refused: "must be ...". The caller adds its location.
struct BadValue {
  std::string why;
};

/// Sets the field, or throws BadValue and leaves it unchanged.
void assign(const Setting& setting, const TomlValue& value);

/// The same for command-line text, where strings need no quotes.
void assign_text(const Setting& setting, std::string_view text);

}  // namespace incognita
