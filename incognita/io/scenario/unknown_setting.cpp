#include "incognita/io/scenario/unknown_setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "incognita/io/scenario/renamed_settings.hpp"
#include "incognita/io/scenario/scenario_tree.hpp"
#include "incognita/math/nearest_name.hpp"

namespace incognita {
namespace {

/// One value for each choice.
using Choices = std::map<std::string, std::string>;

/// The settings of a scenario with these choices; nothing if they refuse one of its given words.
std::optional<std::vector<SettingInForce>> settings_with(GivenValues given, const Choices& choices,
                                                         bool strict) {
  for (const auto& [key, value] : choices) given[key] = {GivenValue{value, ""}};
  SettingReader reader(given);
  Scenario scenario;
  read_settings(reader, scenario);
  if (strict && !reader.refused_words().empty()) return std::nullopt;
  return reader.settings();
}

/// Visits the scenarios that differ from the given one in a choice, then in two, and so on, as long as they have new
/// settings. `visit` gets the choices and the settings, and returns whether to go on.
template <class Visit>
void search(const GivenValues& given, bool strict, Visit visit) {
  std::set<std::string> known;
  std::deque<Choices> next{{}};
  const auto is_new = [&](const std::vector<SettingInForce>& settings) {
    bool found = false;
    for (const SettingInForce& s : settings) found |= known.insert(s.key).second;
    return found;
  };
  const auto first = settings_with(given, {}, false);
  is_new(*first);
  if (!visit(Choices{}, *first)) return;
  while (!next.empty()) {
    const Choices choices = std::move(next.front());
    next.pop_front();
    const auto current = settings_with(given, choices, false);
    // The last choice is the most specific one, and explains best
    for (auto setting = current->rbegin(); setting != current->rend(); ++setting)
      for (const std::string& option : setting->options) {
        if (option == setting->value || choices.contains(setting->key)) continue;
        Choices other = choices;
        other[setting->key] = option;
        const auto settings = settings_with(given, other, strict);
        if (!settings) continue;
        if (!visit(other, *settings)) return;
        if (is_new(*settings)) next.push_back(std::move(other));
      }
  }
}

using Wanted = std::function<bool(const SettingInForce& setting)>;

/// The fewest other choices with which the scenario has a setting that satisfies the condition. Nothing if no choices
/// give it one.
std::optional<Context> find_choices(const GivenValues& given, bool strict, const Wanted& wanted) {
  std::optional<Context> found;
  std::size_t depth = 0;
  search(given, strict, [&](const Choices& choices, const std::vector<SettingInForce>& settings) {
    if (found && choices.size() > depth) return false;
    if (std::none_of(settings.begin(), settings.end(), wanted)) return true;
    if (!found) {
      found.emplace();
      depth = choices.size();
      for (const auto& [key, value] : choices) (*found)[key] = {value};
    } else if (depth == 1 && found->contains(choices.begin()->first)) {
      (*found)[choices.begin()->first].push_back(choices.begin()->second);
    }
    return true;
  });
  return found;
}

/// Prefers choices that leave the given ones as they are.
std::optional<Context> find_choices(const GivenValues& given, const Wanted& wanted) {
  if (auto found = find_choices(given, true, wanted)) return found;
  return find_choices(given, false, wanted);
}

std::string in_words(const Context& context) {
  std::string text;
  for (const auto& [key, values] : context)
    text += fmt::format("{}`{} = {}`", text.empty() ? "" : " with ", key, fmt::join(values, " or "));
  return text;
}

/// "; here it is "point"" for a single choice.
std::string here(const Context& context, const SettingReader& reader) {
  std::string text;
  for (const SettingInForce& s : reader.settings())
    if (context.contains(s.key))
      text += fmt::format("{}`{} = {}`", text.empty() ? "" : " and ", s.key, s.value);
  return text.empty() ? "" : "; here " + text;
}

std::vector<std::string> keys_of(const SettingReader& reader, const std::string& section = "") {
  std::vector<std::string> keys;
  for (const SettingInForce& s : reader.settings())
    if (section.empty() || section_of(s.key) == section) keys.push_back(s.key);
  return keys;
}

std::vector<std::string> sections_of(const SettingReader& reader) {
  std::vector<std::string> sections;
  for (const SettingInForce& s : reader.settings()) sections.push_back(section_of(s.key));
  return sections;
}

/// Whether a word of that section was refused, which may decide on other settings of the section.
bool has_refused_word(const SettingReader& reader, const std::string& section) {
  const auto& refused = reader.refused_words();
  return std::any_of(refused.begin(), refused.end(),
                     [&](const auto& word) { return section_of(word.first) == section; });
}

bool is_section(const SettingReader& reader, const std::string& section) {
  return !keys_of(reader, section).empty();
}

bool is_of_any_scenario(const std::string& section) {
  return find_choices({}, [&](const SettingInForce& s) { return section_of(s.key) == section; }).has_value();
}

/// Whether all settings of the section have other names now.
bool is_former(const std::string& section) {
  return !new_sections(section).empty() && !is_of_any_scenario(section);
}

std::string no_section(const std::string& section, const std::string& at, const SettingReader& reader) {
  if (const std::vector<std::string> now = new_sections(section); !now.empty())
    return fmt::format("{}: section `{}` is now `{}`", at, section, fmt::join(now, "`, `"));
  return fmt::format("{}: there is no section `{}`; the nearest is `{}`", at, section,
                     nearest_name(section, sections_of(reader)));
}

/// "`room`, `points` or `recording`" with the words of another context added.
std::string with_words(const std::string& allowed, const std::vector<std::string>& options) {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = allowed.find('`', at)) != std::string::npos;) {
    const std::size_t end = allowed.find('`', at + 1);
    words.push_back(allowed.substr(at, end - at + 1));
    at = end + 1;
  }
  for (const std::string& option : options) {
    const std::string word = "`" + option.substr(1, option.size() - 2) + "`";  // without quotes
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
  }
  if (words.size() < 2) return fmt::format("{}", fmt::join(words, ""));
  return fmt::format("{} or {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

}  // namespace

std::vector<CatalogedSetting> all_settings() {
  std::vector<CatalogedSetting> all;
  std::map<std::string, std::size_t> known;
  search({}, false, [&](const Choices& choices, const std::vector<SettingInForce>& settings) {
    Context context;
    for (const auto& [key, value] : choices) context[key] = {value};
    for (const SettingInForce& s : settings)
      if (const auto [at, is_new] = known.emplace(s.key, all.size()); is_new)
        all.push_back({s, context});
      else if (s.allowed.starts_with('`'))
        all[at->second].setting.allowed = with_words(all[at->second].setting.allowed, s.options);
    return true;
  });
  std::vector<std::string> sections;
  for (const CatalogedSetting& s : all) sections.push_back(section_of(s.setting.key));
  const auto rank = [&](const CatalogedSetting& s) {
    return std::find(sections.begin(), sections.end(), section_of(s.setting.key)) - sections.begin();
  };
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return all;
}

std::vector<std::string> explained_problems(const GivenValues& given, const SettingReader& reader) {
  const std::vector<std::string>& problems = reader.problems();
  GivenValues others = given;
  for (const auto& [key, refused] : reader.refused_words()) others.erase(key);
  std::map<std::size_t, std::string> explanations;  // by problem
  std::size_t first_unknown = problems.size();
  for (const auto& [key, refused] : reader.refused_words()) {
    const auto& [word, problem] = refused;
    const std::optional<Context> context = find_choices(others, [&](const SettingInForce& s) {
      return s.key == key && std::find(s.options.begin(), s.options.end(), word) != s.options.end();
    });
    if (context)
      explanations[problem] =
          fmt::format("; {} belongs to {}{}", word, in_words(*context), here(*context, reader));
    else
      first_unknown = std::min(first_unknown, problem);
  }
  std::vector<std::string> explained;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const auto explanation = explanations.find(i);
    if (explanation == explanations.end())
      explained.push_back(problems[i]);
    else if (i < first_unknown)
      explained.push_back(problems[i] + explanation->second);
  }
  return explained;
}

std::vector<LeftOut> left_out_by_command_line(const GivenValues& given, const SettingReader& reader) {
  const auto is_typed = [](const auto& entry) { return entry.second.back().order > 0; };
  if (std::none_of(given.begin(), given.end(), is_typed)) return {};
  GivenValues in_file;
  for (const auto& [key, values] : given)
    if (values.front().order == 0) in_file[key] = {values.front()};
  SettingReader alone(in_file);
  Scenario scenario;
  read_settings(alone, scenario);
  std::vector<LeftOut> left_out;
  for (const auto& [key, values] : given)
    if (!reader.has(key) && alone.has(key) && values.back().order == 0)
      left_out.push_back(
          {key, fmt::format("{} ({}) is left out: it belongs to a choice that the command line replaces", key,
                            values.back().source)});
  return left_out;
}

std::vector<std::string> explain_unknown(const GivenValues& given, const SettingReader& reader) {
  std::vector<std::string> problems;
  std::set<std::string> explained;  // sections
  const std::vector<LeftOut> left_out = left_out_by_command_line(given, reader);
  const auto is_left_out = [&](const std::string& key) {
    return std::any_of(left_out.begin(), left_out.end(), [&](const LeftOut& l) { return l.key == key; });
  };
  for (const auto& [key, values] : given) {
    if (reader.has(key) || is_left_out(key)) continue;
    const GivenValue& value = values.back();
    if (value.is_renamed) continue;
    const std::string section = section_of(key);
    const bool whole = !value.section_source.empty() && !is_section(reader, section);
    if (whole && !explained.insert(section).second) continue;
    const auto wanted = [&](const SettingInForce& other) {
      return whole ? section_of(other.key) == section : other.key == key;
    };
    const std::optional<Context> context = find_choices(given, wanted);
    if (context ? reader.refused_choice() : has_refused_word(reader, section))
      continue;  // it may follow from the refused value
    const std::string& at = whole ? value.section_source : value.source;
    const std::string what = whole ? fmt::format("section `{}`", section) : fmt::format("`{}`", key);
    if (context)
      problems.push_back(
          fmt::format("{}: {} belongs to {}{}", at, what, in_words(*context), here(*context, reader)));
    else if (whole || is_former(section))
      problems.push_back(no_section(section, at, reader));
    else
      problems.push_back(
          fmt::format("{}: there is no setting `{}`; the nearest is `{}`", at, key,
                      nearest_name(key, keys_of(reader, is_section(reader, section) ? section : ""))));
  }
  return problems;
}

std::string explain_empty_section(const std::string& section, const std::string& source,
                                  const SettingReader& reader) {
  return is_section(reader, section) || is_of_any_scenario(section) ? ""
                                                                    : no_section(section, source, reader);
}

}  // namespace incognita
