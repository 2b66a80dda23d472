#include "incognita/report/run_figures.hpp"

#include <array>
#include <system_error>
#include <utility>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/row_file.hpp"
#include "incognita/report/figure_scripts.hpp"
#include "incognita/report/gnuplot.hpp"
#include "incognita/report/team_figures.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::pair<const char*, FigureScript>, 6> figures{{{"map", map_script},
                                                                       {"errors", errors_script},
                                                                       {"entropy", entropy_script},
                                                                       {"decision", decision_script},
                                                                       {"vehicles", vehicles_script},
                                                                       {"control", control_script}}};

}  // namespace

std::vector<std::string> draw_run_figures(const fs::path& run_directory, AlignmentKind alignment) {
  std::error_code error;
  fs::create_directories(run_directory / "figures", error);
  if (error) throw RecordError(write_failure(run_directory / "figures", error.value()));
  std::vector<std::string> warnings;
  for (const auto& [name, script_of] : figures) {
    const auto script = script_of(run_directory, alignment);
    if (!script) continue;
    write_whole_file(run_directory / "figures" / (std::string(name) + ".gp"), *script);
    const std::string warning = draw_script(run_directory, name);
    if (!warning.empty() && (warnings.empty() || warnings.back() != warning)) warnings.push_back(warning);
  }
  return warnings;
}

}  // namespace incognita
