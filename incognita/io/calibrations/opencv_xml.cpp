// XML of OpenCV's FileStorage: a flat list of numbers and matrices below <opencv_storage>. OpenCV's own parser reads beyond the end
// of truncated files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "incognita/io/calibrations/calibration_readers.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::string_view xml_root = "<opencv_storage>", xml_end = "</opencv_storage>";

struct XmlElement {
  std::string name;
  std::string_view content;
  std::size_t line = 1;
};

std::size_t line_at(std::string_view text, std::size_t at) {
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

class XmlReader {
 public:
  XmlReader(const std::filesystem::path& file, std::string_view text) : file_(file), text_(text) {
    const std::size_t root = text.find(xml_root);
    if (root == std::string_view::npos) refuse(0, "is not XML of OpenCV: it has no <opencv_storage>");
    at_ = root + xml_root.size();
  }

  /// The next element, without comments; nothing after the last one.
  std::optional<XmlElement> next() {
    for (;;) {
      const std::size_t begin = at_ = find("<", at_, "</opencv_storage>");
      if (text_.substr(begin).starts_with(xml_end)) return std::nullopt;
      if (!text_.substr(begin).starts_with("<!--")) break;
      at_ = find("-->", begin, "the end of a comment");
    }
    const std::size_t begin = at_, close = find(">", begin, "`>`");
    const std::string_view tag = text_.substr(begin + 1, close - begin - 1);
    const std::string name(tag.substr(0, tag.find_first_of(" \t\r\n/")));
    const bool named = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
      return std::isalnum(c) || c == '_';
    });
    if (!named) refuse(begin, "has an element without a name");
    if (tag.back() == '/') {
      at_ = close + 1;
      return XmlElement{name, {}, line_at(text_, begin)};
    }
    const std::string end = "</" + name + ">";
    const std::size_t until = find(end, close, end);
    at_ = until + end.size();
    return XmlElement{name, text_.substr(close + 1, until - close - 1), line_at(text_, begin)};
  }

 private:
  std::size_t find(std::string_view what, std::size_t from, std::string_view missing) const {
    const std::size_t found = text_.find(what, from);
    if (found == std::string_view::npos) refuse(from, fmt::format("is truncated: {} is missing", missing));
    return found;
  }
  [[noreturn]] void refuse(std::size_t at, const std::string& why) const {
    throw InputError(fmt::format("{}:{}: {}", shown(file_), line_at(text_, at), why));
  }

  std::filesystem::path file_;
  std::string_view text_;
  std::size_t at_ = 0;
};

/// The text of an element, or that of its <data>; empty if it has other elements.
std::string_view data_of(const XmlElement& element) {
  constexpr std::string_view begin = "<data>", end = "</data>";
  const std::size_t from = element.content.find(begin), to = element.content.find(end);
  if (from != std::string_view::npos && to != std::string_view::npos && from < to)
    return element.content.substr(from + begin.size(), to - from - begin.size());
  return element.content.find('<') == std::string_view::npos ? element.content : std::string_view();
}

/// The numbers in a text; empty if it has other words.
std::vector<std::string> number_words(std::string_view text) {
  std::vector<std::string> found;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (*end != '\0' || !std::isfinite(number)) return {};
    found.push_back(fmt::format("{}", number));
  }
  return found;
}

}  // namespace

std::string opencv_xml_as_yaml(const std::filesystem::path& file, const std::string& text) {
  std::string yaml;
  std::size_t line = 1;
  XmlReader reader(file, text);
  while (const auto element = reader.next()) {
    const std::vector<std::string> numbers = number_words(data_of(*element));
    const bool has_data = element->content.find("<data>") != std::string_view::npos;
    if (numbers.empty() && has_data)
      throw InputError(
          fmt::format("{}:{}: {} must hold numbers only", shown(file), element->line, element->name));
    if (numbers.empty()) continue;
    for (; line < element->line; ++line) yaml += '\n';
    const std::string joined = fmt::format("{}", fmt::join(numbers, ", "));
    yaml += element->name + (has_data || numbers.size() > 1 ? ": [" + joined + "]\n" : ": " + joined + "\n");
    ++line;
  }
  if (yaml.empty()) throw InputError(shown(file) + ": has no numbers");
  return yaml;
}

}  // namespace incognita
