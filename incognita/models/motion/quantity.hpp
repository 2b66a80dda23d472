// Names and units of the numbers of a model, and its user-settable parameters.
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

/// One number of a state, error, input or measurement, or a parameter.
struct Quantity {
  std::string_view name;       ///< "speed"
  std::string_view unit;       ///< "m/s"; empty for ratios
  std::string_view kind = {};  ///< shared key for one sigma or limit: "acceleration" for ax, ay, az

  /// The name with its unit, as in files and settings: "speed_m_s".
  std::string key() const;
  /// The kind with its unit; key() without a kind.
  std::string kind_key() const;
};

/// A value for all quantities with that kind_key(): {"speed_m_s", 0.5}.
struct KeyedValue {
  std::string_view key;
  double value;
};
/// One number per quantity. Throws std::invalid_argument naming a quantity without a value.
SmallVector values_of(std::span<const Quantity> quantities, std::initializer_list<KeyedValue> values);

/// A unit as a key suffix: "m_s2" for "m/s^2", "per_m" for "1/m".
std::string unit_suffix(std::string_view unit);

/// Admissible values of a parameter.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool more_than_least = false;  ///< `least` itself is excluded

  constexpr bool contains(double value) const {
    return value <= most && (more_than_least ? value > least : value >= least);
  }
};

/// A user-settable number of a model. Its default is the initializer of the model's member.
template <class Model>
struct Parameter {
  Quantity quantity;
  double& (*in)(Model&);  ///< accessor of the member
  Range range;
  std::string_view help;  ///< one sentence
};

/// A parameter without its model type, for settings, tables and checks.
struct ParameterInfo {
  Quantity quantity;
  Range range;
  double default_value = 0;
  std::string_view help;
};

/// The parameters of a model; none if it does not declare any.
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
