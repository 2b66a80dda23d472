// Messages about invalid command lines.
#pragma once

#include <string>

namespace CLI {
class App;
class Error;
}  // namespace CLI

namespace incognita {

/// Names the unknown command or option and the nearest known one, else returns the parser's message.
std::string usage_message(const CLI::App* app, const CLI::Error& error);

}  // namespace incognita
