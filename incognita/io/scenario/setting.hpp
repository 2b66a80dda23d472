// One setting: which field of a scenario a key means, in what unit, and what values are allowed.
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

/// What a setting may be.
struct Allowed {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool more_than_least = false;  ///< `least` itself is excluded
  bool odd = false;
  std::vector<std::string> choices;  ///< of a text; any text when empty

  /// "0 to 1", "more than 0", "`room` or `recording`"; empty when anything goes.
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
  std::string unit;  ///< empty for counts, ratios and texts
  std::string help;
  Allowed allowed;

  /// The value in force, as TOML.
  std::string written() const;
  /// "a text", "a whole number", ...
  std::string kind() const;
};

/// Why a value was refused: "must be ...". The caller adds where it was written.
struct BadValue {
  std::string why;
};

/// Sets the field or throws BadValue and leaves it as it was.
void assign(const Setting& setting, const TomlValue& value);

/// The same from the command line, where a text needs no quotes.
void assign_text(const Setting& setting, std::string_view text);

}  // namespace incognita
