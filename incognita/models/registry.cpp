#include "incognita/models/registry.hpp"

#include <algorithm>
#include <stdexcept>

#include "incognita/math/nearest_name.hpp"

namespace incognita {
namespace {

[[noreturn]] void refuse(const char* what, std::string_view name, const std::vector<std::string>& names) {
  const std::string given(name);
  throw std::invalid_argument("`" + given + "` is not a " + what + "; the nearest is `" +
                              nearest_name(given, names) + "`");
}

}  // namespace

const std::vector<MotionEntry>& registered_motions() {
  static const std::vector<MotionEntry> entries = [] {
    std::vector<MotionEntry> list;
    for_each_type<AnyMotion>([&]<class M>(std::type_identity<M>) {
      list.push_back({motion_traits<M>, parameter_infos<M>()});
    });
    return list;
  }();
  return entries;
}

const std::vector<SensorEntry>& registered_sensors() {
  static const std::vector<SensorEntry> entries = [] {
    std::vector<SensorEntry> list;
    for_each_type<AnySensor>([&]<class S>(std::type_identity<S>) {
      list.push_back({sensor_traits<S>, parameter_infos<S>()});
    });
    return list;
  }();
  return entries;
}

std::vector<std::string> motion_names() {
  std::vector<std::string> names;
  for (const MotionEntry& entry : registered_motions()) names.emplace_back(entry.traits.name);
  return names;
}

std::vector<std::string> sensor_words() {
  std::vector<std::string> words;
  for (const SensorEntry& entry : registered_sensors()) {
    std::string word(entry.traits.word);
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(std::move(word));
  }
  return words;
}

AnyMotion make_motion(std::string_view name) {
  bool found = false;
  AnyMotion made;
  for_each_type<AnyMotion>([&]<class M>(std::type_identity<M>) {
    if (M::name == name) made.emplace<M>(), found = true;
  });
  if (!found) refuse("motion model", name, motion_names());
  return made;
}

const MotionTraits& motion_traits_of(std::string_view name) {
  for (const MotionEntry& entry : registered_motions())
    if (entry.traits.name == name) return entry.traits;
  refuse("motion model", name, motion_names());
}

const SensorTraits& sensor_traits_of(std::string_view word, const MotionTraits& motion) {
  const SensorTraits* found = nullptr;
  bool fits = false;
  for_each_type<AnySensor>([&]<class S>(std::type_identity<S>) {
    if (S::word != word || fits) return;
    fits = S::incompatibility(motion).empty();
    if (!found || fits || S::name == word) found = &sensor_traits<S>;
  });
  if (!found) refuse("sensor", word, sensor_words());
  return *found;
}

AnySensor make_sensor(std::string_view word, const MotionTraits& motion) {
  const std::string_view name = sensor_traits_of(word, motion).name;
  AnySensor made;
  for_each_type<AnySensor>([&]<class S>(std::type_identity<S>) {
    if (S::name == name) made.emplace<S>();
  });
  return made;
}

void set_terrain(AnyMotion& motion, const Terrain& terrain) {
  std::visit(
      [&](auto& model) {
        if constexpr (requires { model.terrain = terrain; }) model.terrain = terrain;
      },
      motion);
}

void set_camera(AnySensor& sensor, const Camera& camera, const Mount& mount) {
  std::visit(
      [&](auto& s) {
        if constexpr (requires { s.lens() = camera; }) s.lens() = camera;
        if constexpr (requires { s.mount = mount; }) s.mount = mount;
      },
      sensor);
}

}  // namespace incognita
