// Reads the settings of a scenario top-down: each is bound to its field and assigned before the next one is visited,
// so that a choice decides which settings follow. What is given and never visited means nothing in this scenario.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/io/scenario/setting.hpp"
#include "incognita/models/motion/quantity.hpp"

namespace incognita {

/// One value given for a setting, in a file or on the command line.
struct GivenValue {
  std::variant<TomlValue, std::string> value;  ///< text of the command line as typed
  std::string source;                          ///< "room.toml:12", "--set"
  std::string section_source = {};             ///< the file's line of the section
  int order = 0;                               ///< on the command line
  bool is_renamed = false;                     ///< given by a former name, which is refused elsewhere
};

/// All values given, by key; later ones override earlier ones.
using GivenValues = std::map<std::string, std::vector<GivenValue>>;

class SettingReader {
 public:
  explicit SettingReader(const GivenValues& given) : given_(given) {}

  /// The settings visited from here on belong to that section.
  void section(std::string name) { section_ = std::move(name); }

  /// Visits all settings that a struct declares.
  template <class S>
  void all(S& s) {
    S::describe([&](auto member, const char* name, const char* unit, const Limits& limits, const char* help) {
      visit(s.*member, name, unit, limits, help);
    });
  }

  /// Visits these settings of a struct, in the order of its declaration.
  template <class S, class... Member>
  void some(S& s, Member S::*... members) {
    S::describe([&](auto member, const char* name, const char* unit, const Limits& limits, const char* help) {
      if ((is_same(member, members) || ...)) visit(s.*member, name, unit, limits, help);
    });
  }

  /// Visits a setting, of which only those words can be chosen here.
  template <class S, class Member>
  void choice(S& s, Member S::*member, std::vector<std::string> words) {
    words_ = std::move(words);
    some(s, member);
    words_.clear();
  }

  /// Visits a setting that has the value of another one unless it is given.
  template <class S, class Member>
  void follower(S& s, Member S::*member, std::string key) {
    follows_ = std::move(key);
    some(s, member);
    follows_.clear();
  }

  /// Visits a choice between structs, and the settings of the one chosen.
  template <class S, class... Alternative>
  void alternative(S& s, std::variant<Alternative...> S::*member) {
    some(s, member);
    std::visit([&](auto& chosen) { all(chosen); }, s.*member);
  }

  /// Visits the parameters that a model declares.
  template <class Model>
  void parameters(Model& model) {
    for (const Parameter<Model>& p : parameters_of<Model>()) parameter(p.in(model), p);
  }
  void parameter(double& field, const auto& p) {
    visit(field, p.quantity.key(), std::string(p.quantity.unit),
          {.least = p.range.least, .most = p.range.most, .more_than_least = p.range.more_than_least},
          std::string(p.help));
  }

  /// A value that replaces the default of settings visited later; `source` says where it comes from.
  void defaults_are(std::string source) { default_source_ = std::move(source); }
  bool has_given(std::string_view section) const;
  /// Refuses the value of a setting that was visited.
  void refuse(const std::string& key, const std::string& why);

  const std::vector<SettingInForce>& settings() const { return settings_; }
  bool has(const std::string& key) const { return visited_.contains(key); }
  /// The values that were refused, with their location.
  const std::vector<std::string>& problems() const { return problems_; }
  /// Whether a value was refused that decides on other settings.
  bool refused_choice() const { return refused_choice_; }
  /// Words that were refused, in TOML by key, with the index of their problem: other choices may admit them.
  const std::map<std::string, std::pair<std::string, std::size_t>>& refused_words() const {
    return refused_words_;
  }
  /// Values replaced by the command line, with their order there.
  const std::map<int, std::string>& overrides() const { return overrides_; }

 private:
  template <class A, class B>
  static bool is_same(A a, B b) {
    if constexpr (std::is_same_v<A, B>)
      return a == b;
    else
      return false;
  }

  template <class Field>
  void visit(Field& field, const std::string& name, const std::string& unit, const Limits& limits,
             const std::string& help) {
    Setting setting{section_ + "." + name, {}, unit, limits, help, words_};
    if constexpr (std::is_enum_v<Field>) {
      if (words_.empty())
        for (const auto& [value, word] : enum_words<Field>) setting.words.emplace_back(word);
      setting.field =
          Choice{[&field, words = setting.words] {
                   const auto at = std::find(words.begin(), words.end(), word_of(field));
                   return static_cast<std::size_t>(at - words.begin());
                 },
                 [&field, words = setting.words](std::size_t i) { field = enum_of<Field>(words[i]); }};
    } else if constexpr (requires { field.valueless_by_exception(); }) {
      setting.words.assign(alternative_words<Field>.begin(), alternative_words<Field>.end());
      setting.field =
          Choice{[&field] { return field.index(); }, [&field](std::size_t i) { choose(field, i); }};
    } else {
      setting.field = &field;
    }
    read(setting);
  }

  /// Replaces the alternative by the default of the i-th one, unless it is that one.
  template <class... Alternative>
  static void choose(std::variant<Alternative...>& field, std::size_t i) {
    static const std::array<std::variant<Alternative...>, sizeof...(Alternative)> all{Alternative{}...};
    if (field.index() != i) field = all[i];
  }

  void read(const Setting& setting);
  void follow(const Setting& setting, std::string& source);
  void assign_given(const Setting& setting, const GivenValue& given, bool is_replaced, std::string& source);

  const GivenValues& given_;
  std::string section_, follows_, default_source_ = "default";
  std::vector<std::string> words_;
  std::vector<SettingInForce> settings_;
  std::set<std::string> visited_;
  std::vector<std::string> problems_;
  std::map<int, std::string> overrides_;
  bool refused_choice_ = false;
  std::map<std::string, std::pair<std::string, std::size_t>> refused_words_;
};

}  // namespace incognita
