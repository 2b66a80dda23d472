// The words of a scenario for the values of enumerations and for the alternatives of variants.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "incognita/io/scenario/scenario.hpp"

namespace incognita {

template <class Enum>
struct EnumWord {
  Enum value;
  const char* word;
};

/// The words of an enumeration; for each a specialization below.
template <class Enum>
inline constexpr auto enum_words = nullptr;

template <>
inline constexpr auto enum_words<WorldSettings::Type> =
    std::to_array<EnumWord<WorldSettings::Type>>({{WorldSettings::Type::room, "room"},
                                                  {WorldSettings::Type::points, "points"},
                                                  {WorldSettings::Type::recording, "recording"},
                                                  {WorldSettings::Type::live, "live"},
                                                  {WorldSettings::Type::robot, "robot"}});
template <>
inline constexpr auto enum_words<RecordingSettings::Format> =
    std::to_array<EnumWord<RecordingSettings::Format>>({{RecordingSettings::Format::automatic, "auto"},
                                                        {RecordingSettings::Format::images, "images"},
                                                        {RecordingSettings::Format::tum, "tum"},
                                                        {RecordingSettings::Format::euroc, "euroc"},
                                                        {RecordingSettings::Format::kitti, "kitti"},
                                                        {RecordingSettings::Format::video, "video"},
                                                        {RecordingSettings::Format::bag, "bag"},
                                                        {RecordingSettings::Format::acfr, "acfr"},
                                                        {RecordingSettings::Format::mrclam, "mrclam"},
                                                        {RecordingSettings::Format::tables, "tables"}});
template <>
inline constexpr auto enum_words<RecordingSettings::TruthFrame> =
    std::to_array<EnumWord<RecordingSettings::TruthFrame>>(
        {{RecordingSettings::TruthFrame::own, "own"}, {RecordingSettings::TruthFrame::estimate, "estimate"}});
template <>
inline constexpr auto enum_words<StartSettings::From> = std::to_array<EnumWord<StartSettings::From>>(
    {{StartSettings::From::target, "target"}, {StartSettings::From::free, "free"}});
template <>
inline constexpr auto enum_words<InitializationSettings::Method> =
    std::to_array<EnumWord<InitializationSettings::Method>>(
        {{InitializationSettings::Method::inverse_depth, "inverse-depth"},
         {InitializationSettings::Method::depth_line, "depth-line"}});
template <>
inline constexpr auto enum_words<InitializationSettings::Center> =
    std::to_array<EnumWord<InitializationSettings::Center>>({{InitializationSettings::Center::edges, "edges"},
                                                             {InitializationSettings::Center::peak, "peak"}});
template <>
inline constexpr auto enum_words<InitializationSettings::Selection> =
    std::to_array<EnumWord<InitializationSettings::Selection>>(
        {{InitializationSettings::Selection::grid, "grid"},
         {InitializationSettings::Selection::random_box, "random-box"}});
template <>
inline constexpr auto enum_words<InitializationSettings::ScalePrior> =
    std::to_array<EnumWord<InitializationSettings::ScalePrior>>(
        {{InitializationSettings::ScalePrior::never, "never"},
         {InitializationSettings::ScalePrior::nearer, "nearer"},
         {InitializationSettings::ScalePrior::always, "always"}});
template <>
inline constexpr auto enum_words<Linearization> =
    std::to_array<EnumWord<Linearization>>({{Linearization::analytic, "analytic"},
                                            {Linearization::iterated, "iterated"},
                                            {Linearization::unscented_vehicle, "unscented-vehicle"},
                                            {Linearization::first_estimate, "first-estimate"},
                                            {Linearization::invariant, "invariant"}});
template <>
inline constexpr auto enum_words<BeliefForm> = std::to_array<EnumWord<BeliefForm>>(
    {{BeliefForm::covariance, "covariance"}, {BeliefForm::information, "information"}});
template <>
inline constexpr auto enum_words<MapFrame> =
    std::to_array<EnumWord<MapFrame>>({{MapFrame::world, "world"}, {MapFrame::vehicle, "vehicle"}});
template <>
inline constexpr auto enum_words<Decorrelation> =
    std::to_array<EnumWord<Decorrelation>>({{Decorrelation::nothing, "nothing"},
                                            {Decorrelation::everything, "everything"},
                                            {Decorrelation::map, "map"},
                                            {Decorrelation::map_linear, "map-linear"}});
template <>
inline constexpr auto enum_words<DataAssociationSettings::Method> =
    std::to_array<EnumWord<DataAssociationSettings::Method>>(
        {{DataAssociationSettings::Method::known, "known"},
         {DataAssociationSettings::Method::nearest, "nearest"},
         {DataAssociationSettings::Method::joint, "joint"}});
template <>
inline constexpr auto enum_words<DecisionSettings::Strategy> =
    std::to_array<EnumWord<DecisionSettings::Strategy>>(
        {{DecisionSettings::Strategy::mutual_information, "mutual-information"},
         {DecisionSettings::Strategy::random, "random"},
         {DecisionSettings::Strategy::fixed_path, "fixed-path"},
         {DecisionSettings::Strategy::lawn_mower, "lawn-mower"},
         {DecisionSettings::Strategy::wall_follower, "wall-follower"},
         {DecisionSettings::Strategy::frontier, "frontier"},
         {DecisionSettings::Strategy::plan, "plan"},
         {DecisionSettings::Strategy::none, "none"}});
/// Metrics that compare actions; the Fisher traces only compare camera rotations.
template <>
inline constexpr auto enum_words<Metric> = std::to_array<EnumWord<Metric>>(
    {{Metric::state, "state"}, {Metric::position_and_map, "position-and-map"}, {Metric::vehicle, "vehicle"}});
template <>
inline constexpr auto enum_words<DecisionSettings::Schedule> =
    std::to_array<EnumWord<DecisionSettings::Schedule>>(
        {{DecisionSettings::Schedule::every_frame, "every-frame"},
         {DecisionSettings::Schedule::at_decisions, "at-decisions"},
         {DecisionSettings::Schedule::one_per_frame, "one-per-frame"}});
template <>
inline constexpr auto enum_words<DecisionSettings::Gaze> = std::to_array<EnumWord<DecisionSettings::Gaze>>(
    {{DecisionSettings::Gaze::swing, "swing"},
     {DecisionSettings::Gaze::hold, "hold"},
     {DecisionSettings::Gaze::constant_rate, "constant-rate"},
     {DecisionSettings::Gaze::mutual_information, "mutual-information"},
     {DecisionSettings::Gaze::fisher, "fisher"},
     {DecisionSettings::Gaze::fisher_given_state, "fisher-given-state"}});
template <>
inline constexpr auto enum_words<ExplorationSettings::Counted> =
    std::to_array<EnumWord<ExplorationSettings::Counted>>(
        {{ExplorationSettings::Counted::all, "all"}, {ExplorationSettings::Counted::as_mapped, "as-mapped"}});
template <>
inline constexpr auto enum_words<ExplorationSettings::Placed> =
    std::to_array<EnumWord<ExplorationSettings::Placed>>(
        {{ExplorationSettings::Placed::in_volume, "in-volume"},
         {ExplorationSettings::Placed::on_sides, "on-sides"}});
template <>
inline constexpr auto enum_words<ControlLaw> =
    std::to_array<EnumWord<ControlLaw>>({{ControlLaw::none, "none"},
                                         {ControlLaw::tracking, "tracking"},
                                         {ControlLaw::lqg, "lqg"},
                                         {ControlLaw::feedback_linearization, "feedback-linearization"},
                                         {ControlLaw::active, "active"}});
template <>
inline constexpr auto enum_words<TruePlantSettings::Motion> =
    std::to_array<EnumWord<TruePlantSettings::Motion>>({{TruePlantSettings::Motion::as_modeled, "as-modeled"},
                                                        {TruePlantSettings::Motion::terrain, "terrain"}});

/// The words of the alternatives of a variant, in their order.
template <class Variant>
inline constexpr auto alternative_words = nullptr;
template <>
inline constexpr auto alternative_words<decltype(CameraSettings::model)> =
    std::to_array<const char*>({"wide-angle", "pinhole", "fisheye"});
template <>
inline constexpr auto alternative_words<decltype(TerrainSettings::type)> =
    std::to_array<const char*>({"waves", "plane", "image"});
template <>
inline constexpr auto alternative_words<decltype(MotionSettings::type)> =
    std::to_array<const char*>({"commanded", "trajectory"});
template <>
inline constexpr auto alternative_words<decltype(TrajectoryMotion::axes)> =
    std::to_array<const char*>({"camera", "body"});
template <>
inline constexpr auto alternative_words<decltype(PathSettings::type)> =
    std::to_array<const char*>({"point", "circle", "back-and-forth", "way-points", "file"});

/// Throws std::invalid_argument for a value that a scenario cannot select.
template <class Enum>
requires std::is_enum_v<Enum> std::string word_of(Enum value) {
  for (const auto& [known, word] : enum_words<Enum>)
    if (known == value) return word;
  throw std::invalid_argument("a setting has a value that has no word");
}

/// Throws std::invalid_argument for an unknown word.
template <class Enum>
Enum enum_of(const std::string& word) {
  for (const auto& [known, name] : enum_words<Enum>)
    if (name == word) return known;
  throw std::invalid_argument("`" + word + "` is no word of this setting");
}

template <class... Alternative>
std::string word_of(const std::variant<Alternative...>& value) {
  return alternative_words<std::variant<Alternative...>>[value.index()];
}

}  // namespace incognita
