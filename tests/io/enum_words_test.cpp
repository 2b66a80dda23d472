// Every value of an enumeration that scenarios set has its word: a value without one could not be chosen.
#include "incognita/io/scenario/enum_words.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <typeinfo>
#include <utility>

namespace incognita {
namespace {

/// The compiler prints an enumerator by its name, and any other number as a cast: (Metric)7.
template <auto value>
constexpr bool is_enumerator() {
  constexpr std::string_view text = __PRETTY_FUNCTION__;
  constexpr std::size_t start = text.rfind("value = ");
  static_assert(start != std::string_view::npos);
  return text[start + std::string_view("value = ").size()] != '(';
}

template <class Enum, int... values>
constexpr std::size_t enumerators(std::integer_sequence<int, values...>) {
  return (static_cast<std::size_t>(is_enumerator<static_cast<Enum>(values)>()) + ...);
}

/// `wordless`: values that scenarios cannot set.
template <class Enum>
void expect_words(std::size_t wordless = 0) {
  EXPECT_EQ(enum_words<Enum>.size() + wordless, enumerators<Enum>(std::make_integer_sequence<int, 32>{}))
      << typeid(Enum).name() << " has a value without a word in io/scenario/enum_words.hpp";
}

enum class Three { a, b, c };
static_assert(enumerators<Three>(std::make_integer_sequence<int, 32>{}) == 3);

TEST(EnumWords, NameEveryValue) {
  expect_words<WorldSettings::Type>();
  expect_words<RecordingSettings::Format>();
  expect_words<StartSettings::From>();
  expect_words<InitializationSettings::Method>();
  expect_words<InitializationSettings::Center>();
  expect_words<Linearization>();
  expect_words<BeliefForm>();
  expect_words<MapFrame>();
  expect_words<Decorrelation>();
  expect_words<DataAssociationSettings::Method>();
  expect_words<DecisionSettings::Strategy>();
  expect_words<Metric>(2);  // the Fisher traces compare rotations of a camera only: decision.gaze
  expect_words<DecisionSettings::Schedule>();
  expect_words<DecisionSettings::Gaze>();
  expect_words<ExplorationSettings::Counted>();
  expect_words<ControlLaw>();
  expect_words<TruePlantSettings::Motion>();
}

}  // namespace
}  // namespace incognita
