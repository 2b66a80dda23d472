#include "incognita/report/run_figures.hpp"

#include <array>
#include <fstream>
#include <system_error>
#include <utility>

#include "incognita/messages/errors.hpp"
#include "incognita/record/row_file.hpp"
#include "incognita/report/child_process.hpp"
#include "incognita/report/figure_scripts.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::pair<const char*, FigureScript>, 4> figures{
    {{"map", map_script}, {"errors", errors_script}, {"entropy", entropy_script}, {"advice", advice_script}}};

/// Whether the picture is there to its last line: gnuplot does not say when the disk is full.
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

/// Nothing, or a warning.
std::string draw(const fs::path& run_directory, const std::string& name) {
  const fs::path svg = run_directory / "figures" / (name + ".svg");
  const auto result = run_child({"gnuplot", "figures/" + name + ".gp"}, run_directory);
  std::error_code ignored;
  if (!result) return "gnuplot is not installed: the figures' scripts are there, the figures are not";
  if (result->exit_code != 0) {
    fs::remove(svg, ignored);
    const std::string said = first_line(result->output);
    return "gnuplot could not draw figures/" + name +
           ".gp: " + (said.empty() ? "it ended with code " + std::to_string(result->exit_code) : said);
  }
  if (is_complete(svg)) return "";
  fs::remove(svg, ignored);
  throw RecordError("cannot write " + svg.string() +
                    ": gnuplot left half a figure; is there space on the disk?");
}

}  // namespace

std::vector<std::string> draw_run_figures(const fs::path& run_directory) {
  std::error_code error;
  fs::create_directories(run_directory / "figures", error);
  if (error) throw RecordError(write_failure(run_directory / "figures", error.value()));
  std::vector<std::string> warnings;
  for (const auto& [name, script_of] : figures) {
    const auto script = script_of(run_directory);
    if (!script) continue;
    write_whole_file(run_directory / "figures" / (std::string(name) + ".gp"), *script);
    const std::string warning = draw(run_directory, name);
    if (!warning.empty() && (warnings.empty() || warnings.back() != warning)) warnings.push_back(warning);
  }
  return warnings;
}

}  // namespace incognita
