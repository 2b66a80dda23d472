#include "incognita/models/quantity.hpp"

namespace incognita {
namespace {

std::string with_unit(std::string_view name, std::string_view unit) {
  return unit.empty() ? std::string(name) : std::string(name) + "_" + unit_suffix(unit);
}

}  // namespace

std::string Quantity::key() const { return with_unit(name, unit); }

std::string Quantity::kind_key() const { return with_unit(kind.empty() ? name : kind, unit); }

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
