// Calls a command as the program does, and captures its output.
#pragma once

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace incognita::testing {

struct Captured {
  int code = 0;
  std::string out, err;
};

/// `add` registers the command on an app; exceptions of its job pass through.
inline Captured captured(const std::function<void(CLI::App&, std::function<int()>&)>& add,
                         const std::vector<std::string>& words) {
  CLI::App app;
  std::function<int()> job;
  add(app, job);
  app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes a vector in reverse order
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  Captured result;
  try {
    result.code = job();
  } catch (...) {
    ::testing::internal::GetCapturedStdout();
    ::testing::internal::GetCapturedStderr();
    throw;
  }
  result.out = ::testing::internal::GetCapturedStdout();
  result.err = ::testing::internal::GetCapturedStderr();
  return result;
}

}  // namespace incognita::testing
