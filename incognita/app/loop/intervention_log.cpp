#include "incognita/app/loop/intervention_log.hpp"

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::size_t largest_log = std::size_t{256} << 20;

}  // namespace

std::vector<LoggedIntervention> read_intervention_log(const std::filesystem::path& run_directory) {
  const std::filesystem::path file = run_directory / "interventions.jsonl";
  std::vector<LoggedIntervention> log;
  if (!file_exists(file)) return log;
  std::istringstream lines(read_file(file, largest_log));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (lines.eof() && !nlohmann::json::accept(line)) break;  // cut off when the program was killed
    try {
      log.push_back(from_log_row(line));
      if (log.back().frame < 0) throw InputError("the frame must not be negative");
      if (log.size() > 1 && log.back().frame < log[log.size() - 2].frame)
        throw InputError("the frames must not decrease");
    } catch (const InputError& error) {
      throw InputError(file.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  return log;
}

}  // namespace incognita
