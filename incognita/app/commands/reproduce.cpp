#include "incognita/app/commands/reproduce.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <exception>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "incognita/app/console/folder_lock.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/row_file.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using Experiments = std::vector<Experiment>;

constexpr int max_seeds = 100'000;
constexpr std::size_t largest_ledger = 64 << 20;  // bytes

struct Options {
  std::vector<std::string> ids;
  std::string out = "out/reproduce";
  int seeds = ExperimentSettings{}.seeds;
  std::string update;  ///< a claims.json whose other entries are kept
  bool json = false;
  bool list = false;
};

bool draws(const Experiment& experiment, const std::string& figure) {
  return std::find(experiment.figures.begin(), experiment.figures.end(), figure) != experiment.figures.end();
}

std::vector<std::string> all_ids(const Experiments& experiments) {
  std::vector<std::string> ids;
  for (const Experiment& e : experiments) ids.push_back(e.id);
  for (const Experiment& e : experiments) ids.insert(ids.end(), e.figures.begin(), e.figures.end());
  return ids;
}

/// Index of the example, or of the one that draws the figure.
std::size_t index_of(const std::string& id, const Experiments& experiments) {
  const auto found = std::find_if(experiments.begin(), experiments.end(),
                                  [&](const Experiment& e) { return e.id == id || draws(e, id); });
  if (found != experiments.end()) return static_cast<std::size_t>(found - experiments.begin());
  const std::string nearest = nearest_name(id, all_ids(experiments));
  throw InputError(fmt::format("reproduce: there is no example or figure `{}`{}; --list lists all", id,
                               nearest.empty() ? "" : fmt::format("; the nearest is `{}`", nearest)));
}

/// Each experiment once, in the order of the thesis.
std::vector<const Experiment*> chosen(const std::vector<std::string>& ids, const Experiments& experiments) {
  std::vector<bool> requested(experiments.size(), ids.empty());
  for (const std::string& id : ids) requested[index_of(id, experiments)] = true;
  std::vector<const Experiment*> list;
  for (std::size_t i = 0; i < experiments.size(); ++i)
    if (requested[i]) list.push_back(&experiments[i]);
  return list;
}

int list(const std::vector<const Experiment*>& experiments, bool json) {
  Json document = Json::array();
  for (const Experiment* e : experiments) {
    document.push_back({{"id", e->id}, {"title", e->title}, {"figures", e->figures}});
    const std::string figures = e->figures.empty() ? "" : fmt::format(" ({})", fmt::join(e->figures, ", "));
    if (!json) fmt::print("{:<8} {}{}\n", e->id, e->title, figures);
  }
  if (json) fmt::print("{}\n", document.dump(2));
  return 0;
}

/// `entries` in place of those of `earlier` with their ids, the rest of `earlier` kept; in the order of the thesis.
std::vector<LedgerEntry> merged(const std::vector<LedgerEntry>& earlier,
                                const std::vector<LedgerEntry>& entries, const Experiments& all) {
  std::vector<LedgerEntry> ledger;
  for (const Experiment& e : all)
    for (const std::vector<LedgerEntry>* of : {&entries, &earlier})
      if (const auto found = std::ranges::find(*of, e.id, &LedgerEntry::id); found != of->end()) {
        ledger.push_back(*found);
        break;
      }
  return ledger;
}

void write_ledger(const fs::path& out, const std::vector<LedgerEntry>& entries) {
  write_whole_file(out / "claims.json", ledger_json(entries));
  write_whole_file(out / "claims.md", ledger_markdown(entries));
}

void print_table(const LedgerEntry& entry) {
  fmt::print("{}: {}\n", entry.id, entry.title);
  if (!entry.skipped.empty()) fmt::print("  skipped: {}\n", entry.skipped);
  for (const Claim& claim : entry.claims)
    fmt::print("  {:<18}  {}: {}\n  {:<18}  measured: {}\n", name(claim.finding), claim.place,
               claim.statement, "", claim.measured);
  std::fflush(stdout);  // the next experiment may take a while
}

std::size_t missing_figures(const Options& options, const std::vector<LedgerEntry>& entries) {
  std::size_t missing = 0;
  for (const LedgerEntry& entry : entries)
    missing += static_cast<std::size_t>(
        std::count_if(entry.figures.begin(), entry.figures.end(),
                      [&](const LedgerFigure& f) { return !fs::exists(options.out / fs::path(f.file)); }));
  return missing;
}

/// E.g. `3 claims: 1 holds, 1 misprint, 0 hold on a condition, 1 does not hold, 0 are undecided`.
std::string counted(const std::vector<LedgerEntry>& entries) {
  std::array<std::size_t, 5> counts{};
  std::size_t all = 0;
  for (const LedgerEntry& entry : entries)
    for (const Claim& claim : entry.claims) ++counts[static_cast<std::size_t>(claim.finding)], ++all;
  const auto verb = [](std::size_t n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
  };
  return fmt::format("{}: {}, {}, {}, {}, {}", verb(all, "claim", "claims"), verb(counts[0], "holds", "hold"),
                     verb(counts[1], "misprint", "misprints"),
                     verb(counts[2], "holds on a condition", "hold on a condition"),
                     verb(counts[3], "does not hold", "do not hold"),
                     verb(counts[4], "is undecided", "are undecided"));
}

void report_outcomes(const Options& options, const std::vector<LedgerEntry>& entries) {
  if (const std::size_t missing = missing_figures(options, entries); missing > 0)
    print_message(
        "reproduce: {} figures were not drawn (is gnuplot installed?); their scripts and data are in {}\n",
        missing, (options.out / fs::path("figures")).string());
  if (options.seeds < ExperimentSettings{}.seeds)
    print_message("with {} seeds instead of {} more claims are undecided: fewer runs give wider intervals\n",
                  options.seeds, ExperimentSettings{}.seeds);
  std::vector<std::string> skipped;
  for (const LedgerEntry& entry : entries)
    if (!entry.skipped.empty()) skipped.push_back(entry.id);
  const std::string page = (options.out / fs::path("claims.md")).string();
  if (!skipped.empty()) print_message("skipped: {}; reasons are in {}\n", fmt::join(skipped, ", "), page);
  if (skipped.size() < entries.size()) print_message("{}; see {}\n", counted(entries), page);
}

/// Entries of all experiments that did not fail. The ledger is written after each, so that it survives an early end.
std::vector<LedgerEntry> run_all(const Options& options, const std::vector<const Experiment*>& experiments,
                                 const std::function<void(const std::vector<LedgerEntry>&)>& write) {
  const ExperimentSettings settings{options.out, options.seeds,
                                    [](const std::string& line) { print_message("  {}\n", line); }};
  std::vector<LedgerEntry> entries;
  write(entries);
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const Experiment& experiment = *experiments[i];
    print_message("[{}/{}] {}: {}\n", i + 1, experiments.size(), experiment.id, experiment.title);
    try {
      entries.push_back(experiment.run(settings));
    } catch (const std::exception& error) {
      print_message("reproduce: {} failed: {}\n", experiment.id, error.what());
      continue;
    }
    write(entries);
    const LedgerEntry& entry = entries.back();
    if (!options.json)
      print_table(entry);
    else if (!entry.skipped.empty())
      print_message("  skipped: {}\n", entry.skipped);
  }
  return entries;
}

void make_figures_folder(const std::string& out) {
  std::error_code error;
  fs::create_directories(fs::path(out) / "figures", error);
  if (error) throw RecordError(write_failure(out, error.value()));
}

int reproduce(const Options& options, const Experiments& all) {
  const std::vector<const Experiment*> experiments = chosen(options.ids, all);
  if (options.list) return list(experiments, options.json);
  std::signal(SIGPIPE, SIG_IGN);  // a closed output pipe must not end the job
  std::signal(SIGXFSZ, SIG_IGN);  // makes a full disk a reported error
  if (options.out.empty()) throw InputError("--out: is empty; a folder is required");
  const FolderLock lock(options.out);  // before any file of an earlier run is changed
  make_figures_folder(options.out);
  const std::vector<LedgerEntry> earlier =
      options.update.empty() ? std::vector<LedgerEntry>{}
                             : read_ledger(read_file(options.update, largest_ledger), options.update);
  const std::vector<LedgerEntry> entries =
      run_all(options, experiments, [&](const std::vector<LedgerEntry>& so_far) {
        write_ledger(options.out, merged(earlier, so_far, all));
      });
  if (options.json) fmt::print("{}", ledger_json(entries));
  report_outcomes(options, entries);
  return entries.size() == experiments.size() ? 0 : 1;
}

std::string why_no_count(const std::string& word) {
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc{} && end == word.data() + word.size() && value >= 1 && value <= max_seeds) return "";
  return fmt::format("{}: must be a whole number from 1 to {}", word, max_seeds);
}

}  // namespace

CLI::App* add_reproduce(CLI::App& app, std::function<int()>& job,
                        const std::vector<Experiment>& experiments) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("reproduce", "Reproduce the thesis' examples and figures, and check their claims");
  command->add_option("ID", options->ids, "Examples (3.1) and figures (fig-3.4) [all]")->type_name("");
  command->add_option("--out", options->out, "Folder for claims.json, claims.md and figures/")
      ->type_name("DIR")
      ->capture_default_str();
  command
      ->add_option(
          "--seeds", options->seeds,
          "Independent runs of a statistical claim; expensive claims use fewer, some more: see `runs` in --json")
      ->type_name("N")
      ->check(CLI::Validator(why_no_count, ""))
      ->capture_default_str();
  command
      ->add_option("--update", options->update,
                   "An earlier claims.json: what is not run now is taken from it")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "One JSON document on standard output: docs/schemas");
  command->add_flag("--list", options->list, "Only list the experiments");
  command->footer("Example: incognita reproduce 3.1 fig-3.8 --seeds 50 --out out/examples");
  command->callback([options, &job, &experiments] {
    job = [options, &experiments] { return reproduce(*options, experiments); };
  });
  return command;
}

}  // namespace incognita
