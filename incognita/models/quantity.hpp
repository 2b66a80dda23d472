// What models declare about their numbers: names, units, and the parameters that a user may set.
#pragma once

#include <array>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/math/small_matrix.hpp"

namespace incognita {

/// One number of a state, an error, an input, a measurement, or a parameter.
struct Quantity {
  std::string_view name;  ///< "speed"
  std::string_view unit;  ///< "m/s"; empty for ratios
  std::string_view kind =
      {};  ///< where several numbers share one sigma or limit: "acceleration" for ax, ay, az

  /// The name with its unit, as in files and settings: "speed_m_s".
  std::string key() const;
  /// The same of the kind; key() where there is none.
  std::string kind_key() const;
};

/// A number for every quantity of that key, or of that kind: {"speed_m_s", 0.5}.
struct KeyedValue {
  std::string_view key;
  double value;
};
/// One number for each quantity. Throws std::invalid_argument naming the quantity for which there is none.
SmallVector values_of(std::span<const Quantity> quantities, std::initializer_list<KeyedValue> values);

/// A unit as the end of a key: "m_s2" for "m/s^2", "per_m" for "1/m".
std::string unit_suffix(std::string_view unit);

/// Values that a parameter may have.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool more_than_least = false;  ///< `least` itself is excluded

  constexpr bool contains(double value) const {
    return value <= most && (more_than_least ? value > least : value >= least);
  }
};

/// A number of a model that a user may set. Its default is that of the model's member.
template <class Model>
struct Parameter {
  Quantity quantity;
  double& (*in)(Model&);  ///< where it is
  Range range;
  std::string_view help;  ///< one sentence
};

/// A parameter whatever its model, for settings, tables and checks.
struct ParameterInfo {
  Quantity quantity;
  Range range;
  double default_value = 0;
  std::string_view help;
};

/// Models without parameters need not say so.
template <class Model>
constexpr auto parameters_of() {
  if constexpr (requires { Model::parameters(); })
    return Model::parameters();
  else
    return std::array<Parameter<Model>, 0>{};
}

template <class Model>
std::vector<ParameterInfo> parameter_infos() {
  Model model;
  std::vector<ParameterInfo> infos;
  for (const Parameter<Model>& p : parameters_of<Model>())
    infos.push_back({p.quantity, p.range, p.in(model), p.help});
  return infos;
}

/// Sets each parameter to value(key, default).
template <class Model, class Value>
void set_parameters(Model& model, Value value) {
  for (const Parameter<Model>& p : parameters_of<Model>()) {
    double& number = p.in(model);
    number = value(p.quantity.key(), number);
  }
}

}  // namespace incognita
