#include "incognita/app/commands/campaign.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>

#include "incognita/app/campaign/campaign_folder.hpp"
#include "incognita/app/campaign/campaign_plan.hpp"
#include "incognita/app/campaign/campaign_progress.hpp"
#include "incognita/app/campaign/campaign_report.hpp"
#include "incognita/app/campaign/campaign_workers.hpp"
#include "incognita/app/campaign/requested_measures.hpp"
#include "incognita/app/console/folder_lock.hpp"
#include "incognita/app/console/interrupt.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/report/campaign_limit.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t largest_program = 1 << 30;
constexpr std::size_t most_jobs = 1024, most_shards = 1'000'000;

struct Options {
  CampaignRequest request;
  std::optional<std::string> out, jobs, shard;
  std::vector<std::string> measures;
  bool json = false, keep_runs = false, table_alone = false;
};

void handle_signals() {
  catch_interrupts();
  std::signal(SIGXFSZ, SIG_IGN);  // makes a full disk a reported error
  std::signal(SIGPIPE, SIG_IGN);
}

/// nullopt unless it is an integer from 1 to `most`.
std::optional<std::size_t> count_of(std::string_view text, std::size_t most) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole && value >= 1 && value <= most ? std::optional(value) : std::nullopt;
}

std::size_t jobs_of(const Options& options, const Ranks& ranks) {
  // mpirun already starts one process per simultaneous run.
  if (!options.jobs) return ranks.size() > 1 ? 1 : std::max(1u, std::thread::hardware_concurrency());
  if (const auto jobs = count_of(*options.jobs, most_jobs)) return *jobs;
  throw InputError(fmt::format("--jobs {}: must be a whole number from 1 to {}", *options.jobs, most_jobs));
}

Shard shard_of(const Options& options) {
  if (!options.shard) return {};
  const std::string_view text = *options.shard;
  const std::size_t slash = text.find('/');
  const auto which = count_of(text.substr(0, slash), most_shards);
  const auto of =
      slash == std::string_view::npos ? std::nullopt : count_of(text.substr(slash + 1), most_shards);
  if (!which || !of || *which > *of)
    throw InputError(fmt::format("--shard {}: must be written i/N, i from 1 to N: 1/4, 2/4, 3/4, 4/4", text));
  if (options.table_alone)
    throw InputError("--shard and --table: a shard makes runs, but --table makes none");
  return {*which - 1, *of};
}

/// Unfinished runs of this shard: run index modulo `of` equals `which`.
std::vector<std::size_t> runs_to_make(const CampaignPlan& plan, const CampaignFolder& folder,
                                      const Shard& shard) {
  std::vector<std::size_t> runs;
  for (std::size_t run = shard.which; run < plan.runs(); run += shard.of)
    if (!folder.has(run)) runs.push_back(run);
  return runs;
}

/// Executes the runs and saves each result when it has ended. Returns the number of missing runs. Throws
/// InputError if a run cannot be executed or a requested measure turns out not to exist.
std::size_t make_runs(Ranks& ranks, const CampaignPlan& plan, const CampaignFolder& folder,
                      RequestedMeasures requested, CampaignLead lead) {
  const std::string program = digest_of(read_file("/proc/self/exe", largest_program));
  CampaignProgress progress(plan, lead.runs.size());
  std::size_t ended = 0;
  std::string problem;
  lead.taken = [&](std::size_t run, const RunEnd& end) {
    if (!end.result) {
      if (end.bad_input)
        problem = fmt::format("{}, seed {}: {}", plan.variant_of(run).name, plan.seed_of(run), end.trouble);
      else
        progress.report_trouble(run, end.trouble);
      return !end.bad_input;
    }
    RunResult result = *end.result;
    result.program = program;
    folder.write(run, result);
    ++ended;
    progress.report(run, result);
    requested.add(run, result);
    problem = requested.problem();
    return problem.empty();
  };
  lead.stopping = [] { return interrupted(); };
  problem = requested.problem();
  if (problem.empty()) lead_workers(ranks, lead);
  if (!problem.empty()) {
    folder.discard_what_is_empty();
    throw InputError(problem);
  }
  return lead.runs.size() - ended;
}

void report_work(const CampaignPlan& plan, const Options& options, const Shard& shard, std::size_t to_make) {
  const std::size_t share = (plan.runs() - shard.which + shard.of - 1) / shard.of;
  print_message("{} runs: variants {}, seeds {}{}; {} made before, {} to make\n", plan.runs(),
                plan.variants.size(), plan.seeds.size(),
                options.shard ? fmt::format("; {} of them in shard {}", share, *options.shard) : "",
                share - to_make, to_make);
}

std::optional<fs::path> kept(const fs::path& out, const Options& options, const CampaignPlan& plan,
                             std::size_t run) {
  return options.keep_runs ? std::optional(run_directory(fs::absolute(out), plan, run)) : std::nullopt;
}

/// Reports runs that ended in an earlier call without keeping their run directory.
void report_unkept(const CampaignPlan& plan, const CampaignFolder& folder) {
  std::size_t unkept = 0;
  for (std::size_t run = 0; run < plan.runs(); ++run)
    unkept += folder.has(run) && !fs::exists(run_directory(folder.path(), plan, run));
  if (unkept > 0)
    print_message("--keep-runs: {} runs were made before without it, and are not repeated\n", unkept);
}

std::unique_ptr<FolderLock> locked(const fs::path& out, const std::string& digest,
                                   const std::optional<Shard>& shard) {
  std::optional<SharedCampaign> share;
  if (shard) share = {digest_of(fmt::format("{}/{}", digest, shard->of)), *shard};
  try {
    return std::make_unique<FolderLock>(out, share);
  } catch (const RecordError& error) {
    throw InputError(fmt::format("--out {}: {}", out.string(), error.what()));
  }
}

/// Rank 0, the only one that writes.
int lead(Ranks& ranks, const Options& options, const fs::path& out) {
  const WorkerGuard crew(ranks);
  const std::size_t jobs = jobs_of(options, ranks);
  const Shard shard = shard_of(options);
  limit_measures(options.measures);  // refuses invalid limits
  const CampaignPlan plan = plan_campaign(options.request);
  if (options.table_alone && !fs::is_directory(out / "runs"))
    throw InputError(fmt::format("--table: {} contains no campaign; see --out", out.string()));
  if (options.table_alone)
    return report_campaign(plan, CampaignFolder(out, plan, INCOGNITA_VERSION),
                           {options.measures, options.json});

  const std::string digest = digest_of(plan);
  const auto lock = locked(out, digest, options.shard ? std::optional(shard) : std::nullopt);
  const CampaignFolder folder(out, plan, INCOGNITA_VERSION);
  CampaignLead work{jobs, runs_to_make(plan, folder, shard), digest, {}, {}, {}};
  report_work(plan, options, shard, work.runs.size());
  if (options.keep_runs) report_unkept(plan, folder);
  work.make = [&](std::size_t run) { return make_run(plan, run, kept(out, options, plan, run)); };
  const std::size_t left = make_runs(ranks, plan, folder, {options.measures, plan, folder}, std::move(work));
  folder.tidy();
  if (left > 0) {
    print_message("incognita: {}{} runs are missing; the same command continues\n",
                  interrupted() ? "interrupted: " : "", left);
    return 1;
  }
  if (!options.shard) return report_campaign(plan, folder, {options.measures, options.json});
  print_message("shard {} is done; after all shards, the same command without --shard makes the table\n",
                *options.shard);
  return 0;
}

/// Other ranks. Errors are sent to rank 0, which reports them.
int serve(Ranks& ranks, const Options& options, const fs::path& out) {
  std::size_t jobs = 1;
  std::optional<CampaignPlan> plan;
  std::string wrong;
  try {
    jobs = jobs_of(options, ranks);
    plan = plan_campaign(options.request);
  } catch (const InputError& error) {
    wrong = error.what();
  }
  serve_as_worker(ranks, jobs, [&](std::size_t run, const std::string& digest) {
    if (!plan) return no_run(wrong);
    if (digest_of(*plan) != digest)
      return no_run("the processes differ in the program, the scenario or a file that it refers to");
    return make_run(*plan, run, kept(out, options, *plan, run));
  });
  return 0;
}

int campaign(const Options& options) {
  if (options.out && options.out->empty()) throw InputError("--out: is empty; a folder is required");
  const fs::path out = options.out.value_or("out/campaign");
  handle_signals();
  ::setenv("OPENCV_FOR_THREADS_NUM", "1", 0);  // one run per core is faster than one run on all cores
  Ranks ranks;
  return ranks.rank() == 0 ? lead(ranks, options, out) : serve(ranks, options, out);
}

void add_options(CLI::App& command, Options& options) {
  CampaignRequest& request = options.request;
  command.add_option("scenario", request.scenario, "Scenario file, or the name of a built-in one")
      ->capture_default_str();
  command.add_option("--seeds", request.seeds, "Seeds of every variant: 1..100, or 1,5,10..20")
      ->type_name("LIST")
      ->capture_default_str();
  command
      .add_option(
          "--vary", request.vary,
          "Values of a setting: one variant each; with several --vary one for each combination. Separated by commas outside of brackets and quotes")
      ->type_name("KEY=VALUE,VALUE")
      ->allow_extra_args(false);
  command
      .add_option(
          "--variant", request.variants,
          "Instead of --vary: one variant with these settings, compared with the scenario as it is. Separated by blanks outside of brackets and quotes")
      ->type_name("'KEY=VALUE KEY=VALUE'")
      ->allow_extra_args(false);
  command.add_option("--set", request.sets, "Override a setting in every variant")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--duration", request.duration_s, "Duration of each run")->type_name("S");
  command
      .add_option(
          "--baseline", request.baseline,
          "Variant with which the others are compared; other keys have their first value [the first variant]")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option(
          "--measure", options.measures,
          "Measure in the tables, e.g. ate_m, or ate_m.below:0.1 for the share of runs that are done and below the limit; runs.csv has all measures")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command.add_option("--out", options.out, "Folder of the campaign [out/campaign]")->type_name("DIR");
  command.add_option("--jobs", options.jobs, "Concurrent runs [number of cores; 1 per process of mpirun]")
      ->type_name("N");
  command.add_option("--shard", options.shard, "Make only the i-th of N shares of the runs, without tables")
      ->type_name("i/N");
  command.add_flag("--table", options.table_alone, "Make no runs, only the tables of existing ones");
  command.add_flag("--keep-runs", options.keep_runs, "Keep each run's directory, without figures");
  command.add_flag("--json", options.json, "One JSON document on standard output: docs/schemas");
}

}  // namespace

CLI::App* add_campaign(CLI::App& app, std::function<int()>& job) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "campaign", "Runs over many seeds and settings, with statistics and confidence intervals");
  add_options(*command, *options);
  command->footer(
      "Example:\n  incognita campaign room --seeds 1..50 --vary decision.strategy=none,mutual-information "
      "\\\n"
      "                          --duration 20 --out out/strategies\n");
  command->callback([options, &job] { job = [options] { return campaign(*options); }; });
  return command;
}

}  // namespace incognita
