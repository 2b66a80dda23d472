// Runs another program and waits for it. No shell is involved, so no argument is ever taken for a command.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace incognita {

struct ChildResult {
  int exit_code = 0;   ///< 128 + signal when one ended it
  std::string output;  ///< standard output and error, its first 64 KiB
};

/// `arguments` begins with the program, looked for in PATH. Nothing when there is no such program.
std::optional<ChildResult> run_child(const std::vector<std::string>& arguments,
                                     const std::filesystem::path& folder);

}  // namespace incognita
