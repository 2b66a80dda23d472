// Exceptions that end a job. Only the program turns them into exit codes.
#pragma once

#include <stdexcept>
#include <string>

namespace incognita {

/// Bad usage, configuration or input file: exit code 2. The message states file, line, key or value, and the remedy.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An output could not be written: exit code 1. The message states the file, the cause and the remedy.
struct RecordError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace incognita
