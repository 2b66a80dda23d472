// YAML mappings with the positions of their values; hides the YAML library.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace YAML {
class Node;
}

namespace incognita {

class YamlMap {
 public:
  /// `text`: the content of the file. Throws InputError naming file and line unless it is a YAML mapping. JSON is YAML too.
  YamlMap(const std::filesystem::path& file, std::string text);

  bool has(const char* key) const;
  /// The text of a scalar; empty for another kind of value, or none.
  std::string word(const char* key) const;
  /// All of these throw InputError naming file and line for another kind of value, or none.
  double number(const char* key) const;
  std::vector<double> numbers(const char* key) const;
  /// A matrix in the notation of OpenCV, ROS and EuRoC (`rows`, `cols`, `data`), or a list; row by row.
  std::vector<double> matrix(const char* key) const;

  /// Keys whose values are mappings themselves, in the order of the file.
  std::vector<std::string> sections() const;
  YamlMap section(const std::string& key) const;

  [[noreturn]] void refuse(const char* key, const std::string& why) const;

 private:
  YamlMap(const std::filesystem::path& file, const YAML::Node& node);
  std::vector<double> numbers(const char* key, const YAML::Node& node) const;

  std::filesystem::path file_;
  std::shared_ptr<const YAML::Node> node_;
};

}  // namespace incognita
