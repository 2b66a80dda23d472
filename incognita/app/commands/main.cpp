// The program: selects the command and maps exceptions to exit codes.
#include <CLI/CLI.hpp>
#include <exception>
#include <functional>

#include "incognita/app/commands/adjust.hpp"
#include "incognita/app/commands/calibrate.hpp"
#include "incognita/app/commands/campaign.hpp"
#include "incognita/app/commands/config.hpp"
#include "incognita/app/commands/evaluate.hpp"
#include "incognita/app/commands/observe.hpp"
#include "incognita/app/commands/reproduce.hpp"
#include "incognita/app/commands/robot.hpp"
#include "incognita/app/commands/run.hpp"
#include "incognita/app/commands/target.hpp"
#include "incognita/app/commands/view.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/app/console/shown_reading.hpp"
#include "incognita/app/console/standard_streams.hpp"
#include "incognita/app/console/usage.hpp"
#include "incognita/messages/errors.hpp"

namespace {

enum ExitCode { done = 0, job_failed = 1, bad_input = 2 };

int carry_out(int argc, char** argv) {
  CLI::App app{
      "incognita: active SLAM. It maps an unknown environment, quantifies its uncertainty, and plans informative motion",
      "incognita"};
  app.set_version_flag("--version", INCOGNITA_VERSION);
  app.require_subcommand(1);
  app.footer("Example:\n  incognita run room\n\nSee `incognita COMMAND --help` for details.\n");
  app.failure_message(incognita::usage_message);
  std::function<int()> job;
  incognita::add_run(app, job);
  incognita::add_evaluate(app, job);
  incognita::add_adjust(app, job);
  incognita::add_calibrate(app, job);
  incognita::add_config(app, job);
  incognita::add_target(app, job);
  incognita::add_observe(app, job);
  incognita::add_campaign(app, job);
  incognita::add_view(app, job);
  incognita::add_robot(app, job);
  incognita::add_reproduce(app, job, incognita::all_experiments());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : bad_input;
  }
  try {
    const incognita::ShownReading shown;
    return job();
  } catch (const incognita::InputError& error) {
    incognita::print_message("incognita: {}\n", error.what());
    return bad_input;
  } catch (const std::exception& error) {
    incognita::print_message("incognita: {}\n", error.what());
    return job_failed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  incognita::take_closed_streams();
  const int code = carry_out(argc, argv);
  const std::string lost = incognita::why_output_failed();
  if (lost.empty()) return code;
  incognita::print_message("incognita: standard output: {}\n", lost);
  return code == done ? job_failed : code;
}
