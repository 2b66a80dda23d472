#include "incognita/app/commands/observe.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include "incognita/analysis/observability/observability.hpp"
#include "incognita/analysis/systems/system_error.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/io/formats/system_file.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/report/observability_answer.hpp"

namespace incognita {
namespace {

struct Options {
  std::string system, representation;
  ObservabilitySettings analysis;
  std::optional<int> features;
  std::int64_t seed = 1;
  bool json = false, latex = false, no_lie = false;
};

std::string at(const SystemText& text, SourceLocation location) {
  return location.line > 0 ? fmt::format("{}:{}:{}: ", text.file, location.line, location.column)
                           : text.file + ": ";
}

ObservabilityAnalysis analyze(const SystemText& text, const Options& options) {
  try {
    return analyze_observability(text, options.analysis);
  } catch (const SystemTooLarge& error) {
    throw InputError(
        at(text, error.location) + error.what() +
        "; name large parts under definitions, reduce --lie-order, or omit the Lie derivatives with --no-lie");
  } catch (const SystemError& error) {
    throw InputError(at(text, error.location) + error.what());
  } catch (const std::invalid_argument& error) {
    // Name the system as the user gave it: the file of a built-in system is not the user's.
    throw InputError(options.system + ": " + error.what());
  } catch (const std::bad_alloc&) {
    throw InputError(
        text.file +
        ": not enough memory; reduce --features or --segments, or omit the Lie derivatives with --no-lie");
  }
}

int observe(Options options) {
  if (options.json && options.latex) throw InputError("observe: --json or --latex, not both");
  options.analysis.lie = !options.no_lie;
  const SystemText text = load_system(options.system, options.representation);
  options.analysis.landmarks = options.features.value_or(text.landmark ? 1 : 0);
  options.analysis.seed = static_cast<std::uint64_t>(options.seed);
  const std::size_t states =
      text.vehicle.states.size() +
      (text.landmark ? text.landmark->states.size() * static_cast<std::size_t>(options.analysis.landmarks)
                     : 0);
  constexpr std::size_t takes_long = 400;  // cost is cubic in the number of states
  if (states > takes_long)
    print_message("observe: {} states; singular values of matrices of this size take minutes\n", states);
  const ObservabilityAnalysis analysis = analyze(text, options);
  if (options.json)
    fmt::print("{}", observability_json(analysis, options.analysis));
  else if (options.latex)
    fmt::print("{}", observability_latex(text, analysis));
  else
    fmt::print("{}", observability_table(text, analysis, options.analysis));
  // The other formats include the disagreements.
  if (options.latex)
    for (const std::string& line : analysis.disagreements) print_message("observe: {}\n", line);
  return 0;
}

}  // namespace

CLI::App* add_observe(CLI::App& app, std::function<int()>& job) {
  CLI::App* command =
      app.add_subcommand("observe", "Observability of a system: ranks, null spaces and minimum sigmas");
  const auto o = std::make_shared<Options>();
  std::string names;
  for (const std::string& name : built_in_systems()) names += (names.empty() ? "" : ", ") + name;
  command->add_option("SYSTEM", o->system, "Built-in system (" + names + "), or a file")->required();
  command
      ->add_option("--features", o->features,
                   "Landmarks with estimated position [1; 0 for a system without landmarks]")
      ->check(CLI::Range(0, 500));
  command->add_option("--anchors", o->analysis.anchors, "Landmarks with known position")
      ->check(CLI::Range(0, 500))
      ->capture_default_str();
  command->add_option("--segments", o->analysis.segments, "Segments of the motion, each with its own inputs")
      ->check(CLI::Range(1, 50))
      ->capture_default_str();
  command->add_option("--representation", o->representation, "world or relative [that of the file]")
      ->check(CLI::IsMember({"world", "relative"}));
  command->add_option("--motion", o->analysis.motion, "general, or a motion of the system: straight, ...")
      ->capture_default_str();
  command->add_option("--seed", o->seed, "Seed of the operating point")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
  command->add_option("--lie-order", o->analysis.lie_settings.max_order, "Highest order of Lie derivatives")
      ->check(CLI::Range(0, 30))
      ->capture_default_str();
  command->add_flag("--no-lie", o->no_lie, "Omit the Lie derivatives");
  command->add_flag("--json", o->json, "The answer as JSON");
  command->add_flag("--latex", o->latex, "The matrices, in symbols, as LaTeX");
  command->footer(
      "Example:\n  incognita observe planar --features 2 --anchors 1\n  incognita observe mine.toml --motion "
      "straight --json\n\ndocs/add-a-system.md describes system files.\n");
  command->callback([o, &job] { job = [o] { return observe(*o); }; });
  return command;
}

}  // namespace incognita
