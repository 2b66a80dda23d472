#include "incognita/app/commands/view.hpp"

#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "incognita/app/commands/page_options.hpp"
#include "incognita/app/console/interrupt.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/app/view/laboratory_page.hpp"
#include "incognita/app/view/replay_page.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

struct ViewOptions {
  std::vector<std::string> runs;
  PageOptions page;
};

void serve_until_interrupted(const std::string& address, const PageOptions& options) {
  catch_interrupts();
  std::signal(SIGPIPE, SIG_IGN);
  print_message("the page is at {} until Ctrl-C\n{}", address, hint_for_other_machines(options, address));
  open_in_browser(address);
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

int view(const ViewOptions& options) {
  if (options.runs.size() == 1 && is_laboratory(options.runs[0])) {
    const LaboratoryPage page(options.runs[0], server_settings(options.page));
    serve_until_interrupted(page.address(), options.page);
    return 0;
  }
  if (options.runs.size() > 2)
    throw InputError("view: one run can be replayed, or two compared; " +
                     std::to_string(options.runs.size()) + " were given");
  const ReplayPage page({options.runs.begin(), options.runs.end()}, server_settings(options.page));
  serve_until_interrupted(page.address(), options.page);
  return 0;
}

}  // namespace

CLI::App* add_view(CLI::App& app, std::function<int()>& job) {
  CLI::App* command = app.add_subcommand(
      "view", "Show results in the browser: replay one run, compare two, or read claims and campaigns");
  auto options = std::make_shared<ViewOptions>();
  command
      ->add_option("RUN", options->runs,
                   "Run directory; two are compared; or a folder of `reproduce` or `campaign`")
      ->required();
  command->add_option("--port", options->page.port, "Port of the page [any free one]")->type_name("PORT");
  add_access_options(*command, options->page);
  command->footer(
      "Example: incognita view out/first\n         incognita view out/first out/second --port 8321");
  command->callback([options, &job] { job = [options] { return view(*options); }; });
  return command;
}

}  // namespace incognita
