// Runs another program and waits for it. No shell is involved, so arguments are never interpreted as commands.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace incognita {

struct ChildResult {
  int exit_code = 0;   ///< 128 + signal if it was killed by one
  std::string output;  ///< standard output and error, the first 64 KiB
};

/// Runs `arguments[0]`, searched in PATH, in `folder`. nullopt if there is no such program.
std::optional<ChildResult> run_child(const std::vector<std::string>& arguments,
                                     const std::filesystem::path& folder);

}  // namespace incognita
