// A setting of a scenario: its declaration (math/setting.hpp) with its key, bound to a field.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "incognita/io/formats/toml_value.hpp"
#include "incognita/math/setting.hpp"

namespace incognita {

/// An enumeration or the alternative of a variant, by the index of its word.
struct Choice {
  std::function<std::size_t()> index;
  std::function<void(std::size_t)> choose;
};

using SettingField =
    std::variant<std::string*, int*, std::int64_t*, double*, bool*, Eigen::Vector2d*, Eigen::Vector3d*,
                 std::vector<double>*, std::vector<Eigen::Vector2d>*, std::vector<Eigen::Vector3d>*, Choice>;

struct Setting {
  std::string key;  ///< "section.name"; the name ends with the unit
  SettingField field;
  std::string unit;  ///< empty for counts, ratios and words
  Limits limits;
  std::string help;                     ///< one sentence
  std::vector<std::string> words = {};  ///< admissible texts; of a Choice in the order of its indices

  /// The current value in TOML.
  std::string written() const;
  /// "a text", "a whole number", ...
  std::string kind() const;
  /// "0 to 1", "more than 0", "`room` or `recording`"; empty if unrestricted.
  std::string allowed() const;
};

/// A setting of this scenario with its value and source.
struct SettingInForce {
  std::string key, value, default_value;  ///< values in TOML
  std::string source;  ///< "default", "room.toml:12", "--set", "as vehicle.sigma_speed_m_s"
  std::string unit, allowed, help;
  std::vector<std::string> options;  ///< values in TOML that can make other settings appear
  bool names_file = false;

  bool is_given() const { return source != "default" && !source.starts_with("as "); }
};

/// Why a value was refused: "must be ...". The caller adds its location.
struct BadValue {
  std::string why;
};

/// Sets the field, or throws BadValue and leaves it unchanged.
void assign(const Setting& setting, const TomlValue& value);

/// The same for command-line text, where strings need no quotes.
void assign_text(const Setting& setting, std::string_view text);

/// A value in TOML as a plain value: the inverse of Setting::written(). Throws InputError for anything else.
TomlValue value_of_toml(const std::string& written);

/// "run" of "run.seed".
std::string section_of(const std::string& key);
/// "seed" of "run.seed".
std::string name_in_section(const std::string& key);

}  // namespace incognita
