// TOML texts put together from pieces that may repeat a section.
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace incognita::testing {

/// The text with the lines of repeated sections moved to the first one of that name.
inline std::string merged_toml(const std::string& text) {
  std::vector<std::string> order{""};
  std::map<std::string, std::string> sections;
  std::istringstream lines(text);
  std::string section, line;
  while (std::getline(lines, line)) {
    if (line.starts_with("[")) {
      section = line;
      if (!sections.contains(section)) order.push_back(section);
      sections[section];
    } else {
      sections[section] += line + "\n";
    }
  }
  std::string merged;
  for (const std::string& name : order) merged += (name.empty() ? "" : name + "\n") + sections[name];
  return merged;
}

}  // namespace incognita::testing
