#include "incognita/app/console/usage.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "incognita/math/nearest_name.hpp"

namespace incognita {
namespace {

std::vector<std::string> commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The first word that the parser could not assign.
std::string unknown_word(const CLI::App& app, const std::vector<CLI::App*>& given) {
  const std::vector<std::string> left = (given.empty() ? app : *given.front()).remaining();
  return left.empty() ? "" : left.front();
}

std::string what_is_wrong(const CLI::App& app, const CLI::Error& error) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  const std::string word = unknown_word(app, given);
  const bool is_option = word.starts_with("-");
  if (given.empty() && !is_option) {
    const std::string all = fmt::format("{}", fmt::join(commands(app), ", "));
    if (word.empty()) return fmt::format("a command is required: {}", all);
    return fmt::format("there is no command `{}`; the nearest is `{}` (all: {})", word,
                       nearest_name(word, commands(app)), all);
  }
  if (is_option) {
    const std::string name = word.substr(0, word.find('='));
    return fmt::format("there is no option `{}`; the nearest is `{}`", name,
                       nearest_name(name, options(given.empty() ? app : *given.front())));
  }
  if (!word.empty()) return fmt::format("unexpected argument `{}`", word);
  return error.what();
}

}  // namespace

std::string usage_message(const CLI::App* app, const CLI::Error& error) {
  const std::vector<CLI::App*> given = app->get_subcommands();
  const std::string command = given.empty() ? "" : " " + given.front()->get_name();
  return fmt::format("incognita: {}\nincognita{} --help lists the options\n", what_is_wrong(*app, error),
                     command);
}

}  // namespace incognita
