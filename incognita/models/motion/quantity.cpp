#include "incognita/models/motion/quantity.hpp"

#include <algorithm>
#include <stdexcept>

namespace incognita {
namespace {

std::string with_unit(std::string_view name, std::string_view unit) {
  return unit.empty() ? std::string(name) : std::string(name) + "_" + unit_suffix(unit);
}

}  // namespace

std::string Quantity::key() const { return with_unit(name, unit); }

std::string Quantity::kind_key() const { return with_unit(kind.empty() ? name : kind, unit); }

SmallVector values_of(std::span<const Quantity> quantities, std::initializer_list<KeyedValue> values) {
  SmallVector numbers(static_cast<Eigen::Index>(quantities.size()));
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    const Quantity& quantity = quantities[static_cast<std::size_t>(i)];
    const auto* found =
        std::find_if(values.begin(), values.end(),
                     [key = quantity.kind_key()](const KeyedValue& v) { return v.key == key; });
    if (found == values.end())
      throw std::invalid_argument("no value is set for `" + quantity.kind_key() + "`");
    numbers[i] = found->value;
  }
  return numbers;
}

std::string unit_suffix(std::string_view unit) {
  std::string suffix;
  if (unit.starts_with("1/")) {
    suffix = "per_";
    unit.remove_prefix(2);
  }
  for (const char c : unit)
    if (c == '/')
      suffix += '_';
    else if (c != '^')
      suffix += c;
  return suffix;
}

}  // namespace incognita
