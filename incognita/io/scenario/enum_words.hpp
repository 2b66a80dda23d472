// The words of a scenario for the values of enumerations.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/decision/settings.hpp"
#include "incognita/slam/features/settings.hpp"

namespace incognita {

template <class Enum>
struct EnumWord {
  Enum value;
  const char* word;
};

inline constexpr EnumWord<DecisionSettings::Strategy> strategy_words[] = {
    {DecisionSettings::Strategy::mutual_information, "mutual-information"},
    {DecisionSettings::Strategy::random, "random"},
    {DecisionSettings::Strategy::fixed_path, "fixed-path"},
    {DecisionSettings::Strategy::none, "none"}};
/// Metrics that compare actions; the Fisher traces only compare camera rotations.
inline constexpr EnumWord<Metric> metric_words[] = {
    {Metric::state, "state"}, {Metric::position_and_map, "position-and-map"}, {Metric::vehicle, "vehicle"}};
inline constexpr EnumWord<DecisionSettings::Schedule> schedule_words[] = {
    {DecisionSettings::Schedule::every_frame, "every-frame"},
    {DecisionSettings::Schedule::at_decisions, "at-decisions"},
    {DecisionSettings::Schedule::one_per_frame, "one-per-frame"}};
inline constexpr EnumWord<DecisionSettings::Gaze> gaze_words[] = {
    {DecisionSettings::Gaze::swing, "swing"},
    {DecisionSettings::Gaze::hold, "hold"},
    {DecisionSettings::Gaze::constant_rate, "constant-rate"},
    {DecisionSettings::Gaze::mutual_information, "mutual-information"},
    {DecisionSettings::Gaze::fisher, "fisher"},
    {DecisionSettings::Gaze::fisher_given_state, "fisher-given-state"}};
inline constexpr EnumWord<ExplorationSettings::Counted> counted_words[] = {
    {ExplorationSettings::Counted::all, "all"}, {ExplorationSettings::Counted::as_mapped, "as-mapped"}};
inline constexpr EnumWord<InitializationSettings::Method> method_words[] = {
    {InitializationSettings::Method::inverse_depth, "inverse-depth"},
    {InitializationSettings::Method::depth_line, "depth-line"}};
inline constexpr EnumWord<InitializationSettings::Center> center_words[] = {
    {InitializationSettings::Center::edges, "edges"}, {InitializationSettings::Center::peak, "peak"}};
inline constexpr EnumWord<StartSettings::From> start_words[] = {{StartSettings::From::target, "target"},
                                                                {StartSettings::From::free, "free"}};

inline std::span<const EnumWord<DecisionSettings::Strategy>> words_of(DecisionSettings::Strategy) {
  return strategy_words;
}
inline std::span<const EnumWord<Metric>> words_of(Metric) { return metric_words; }
inline std::span<const EnumWord<DecisionSettings::Schedule>> words_of(DecisionSettings::Schedule) {
  return schedule_words;
}
inline std::span<const EnumWord<DecisionSettings::Gaze>> words_of(DecisionSettings::Gaze) {
  return gaze_words;
}
inline std::span<const EnumWord<ExplorationSettings::Counted>> words_of(ExplorationSettings::Counted) {
  return counted_words;
}
inline std::span<const EnumWord<InitializationSettings::Method>> words_of(InitializationSettings::Method) {
  return method_words;
}
inline std::span<const EnumWord<InitializationSettings::Center>> words_of(InitializationSettings::Center) {
  return center_words;
}
inline std::span<const EnumWord<StartSettings::From>> words_of(StartSettings::From) { return start_words; }

/// Throws std::invalid_argument for a value that a scenario cannot select.
template <class Enum>
std::string word_of(Enum value) {
  for (const auto& [known, word] : words_of(value))
    if (known == value) return word;
  throw std::invalid_argument("a setting has a value that has no word");
}

template <class Enum>
std::vector<std::string> all_words_of(Enum example) {
  std::vector<std::string> all;
  for (const auto& [value, word] : words_of(example)) all.emplace_back(word);
  return all;
}

}  // namespace incognita
