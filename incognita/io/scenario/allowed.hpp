// Factory functions for the allowed values of a setting.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/io/scenario/setting.hpp"
#include "incognita/models/quantity.hpp"

namespace incognita::allowed {

inline Allowed any() { return {}; }
inline Allowed at_least(double least) {
  Allowed a;
  a.least = least;
  return a;
}
inline Allowed more_than(double least) {
  Allowed a = at_least(least);
  a.more_than_least = true;
  return a;
}
inline Allowed between(double least, double most) {
  Allowed a = at_least(least);
  a.most = most;
  return a;
}
inline Allowed above_up_to(double least, double most) {
  Allowed a = between(least, most);
  a.more_than_least = true;
  return a;
}
inline Allowed odd_between(double least, double most) {
  Allowed a = between(least, most);
  a.odd = true;
  return a;
}
/// The range declared by a model.
inline Allowed within(const Range& range) {
  Allowed a = between(range.least, range.most);
  a.more_than_least = range.more_than_least;
  return a;
}
inline Allowed one_of(std::vector<std::string> choices) {
  Allowed a;
  a.choices = std::move(choices);
  return a;
}
/// The words for the values of an enumeration.
template <class Enum>
Allowed words(Enum example) {
  return one_of(all_words_of(example));
}

}  // namespace incognita::allowed
