// Explains settings that a scenario does not have: renamed ones, those of other choices, and misspelled ones.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "incognita/io/scenario/setting_reader.hpp"

namespace incognita {

/// The values of choices that make a setting appear, by key in TOML: {"path.type": ["\"circle\""]}.
using Context = std::map<std::string, std::vector<std::string>>;

/// A setting with the choices that it needs besides the defaults.
struct CatalogedSetting {
  SettingInForce setting;
  Context context;
};

/// Every setting of every scenario, section by section.
std::vector<CatalogedSetting> all_settings();

/// The problems of the reader; a word that other choices admit is explained, unless it may follow from a word before
/// that no choice admits.
std::vector<std::string> explained_problems(const GivenValues& given, const SettingReader& reader);

/// A setting of the file that belongs to a choice of the file that the command line replaces: it means nothing any
/// more, and is no mistake.
struct LeftOut {
  std::string key;
  std::string note;
};
std::vector<LeftOut> left_out_by_command_line(const GivenValues& given, const SettingReader& reader);

/// Explains the other given values of settings that were not visited, one line each.
std::vector<std::string> explain_unknown(const GivenValues& given, const SettingReader& reader);

/// Explains a section without settings, given in line `source` of a file; empty if a scenario can have it.
std::string explain_empty_section(const std::string& section, const std::string& source,
                                  const SettingReader& reader);

}  // namespace incognita
