// The two ways in which a job can end badly. The program turns them into its exit codes, and nothing else
// does.
#pragma once

#include <stdexcept>
#include <string>

namespace incognita {

/// Bad usage, configuration or input file: exit code 2. Says file, line, key or value, and what would be
/// right.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What was to be written could not be: exit code 1. Says which file, why, and what to do about it.
struct RecordError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace incognita
