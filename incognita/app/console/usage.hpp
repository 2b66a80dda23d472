// What is said of a command line that makes no sense.
#pragma once

#include <string>

namespace CLI {
class App;
class Error;
}  // namespace CLI

namespace incognita {

/// The command or option that was not known, with the nearest that is; else what the parser says.
std::string usage_message(const CLI::App* app, const CLI::Error& error);

}  // namespace incognita
