#include "incognita/report/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "incognita/messages/errors.hpp"
#include "incognita/report/child_process.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

/// Whether the picture ends with its last line: gnuplot does not report a full disk.
bool is_complete(const fs::path& svg) {
  std::ifstream in(svg, std::ios::binary | std::ios::ate);
  if (!in) return false;
  const std::streamoff size = in.tellg(), tail = std::min<std::streamoff>(size, 64);
  std::string end(static_cast<std::size_t>(tail), '\0');
  in.seekg(size - tail);
  in.read(end.data(), tail);
  return end.find("</svg>") != std::string::npos;
}

std::string first_line(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n\r\t");
  return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

std::string draw_script(const fs::path& folder, const std::string& name) {
  const fs::path svg = folder / "figures" / (name + ".svg");
  std::error_code ignored;
  const auto result = run_child({"gnuplot", "figures/" + name + ".gp"}, folder);
  if (!result || result->exit_code != 0) fs::remove(svg, ignored);  // an old picture would not show this run
  if (!result)
    return "gnuplot is not installed: scripts of the figures are written, figures are not; install it "
           "(Debian, "
           "Ubuntu: `apt-get install gnuplot-nox`)";
  if (result->exit_code != 0) {
    const std::string said = first_line(result->output);
    return "gnuplot could not draw figures/" + name +
           ".gp: " + (said.empty() ? "it ended with code " + std::to_string(result->exit_code) : said);
  }
  if (is_complete(svg)) return "";
  fs::remove(svg, ignored);
  throw RecordError("cannot write " + svg.string() +
                    ": gnuplot wrote an incomplete figure; is the disk full?");
}

std::string gnuplot_string(const std::string& words) {
  // Double quotes interpret `...` as a command and @ as a macro, and a leading single quote would end a
  // single-quoted string. Special characters are therefore written as octal codes, and so are digits after a
  // code, which would become part of it.
  std::string text = "\"";
  bool was_number = false;
  for (const char c : words) {
    const auto code = static_cast<unsigned char>(c);
    was_number = c == '"' || c == '\\' || c == '`' || c == '@' || (was_number && c >= '0' && c <= '9');
    if (was_number)
      text += fmt::format("\\{:03o}", code);
    else
      text += code < ' ' ? ' ' : c;
  }
  return text + "\"";
}

}  // namespace incognita
