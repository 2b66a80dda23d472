// The page of a program that replays recorded runs.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "incognita/app/view/recorded_runs.hpp"
#include "incognita/live/server.hpp"

namespace incognita {

class ReplayPage {
 public:
  /// `runs`: one run directory, or two to compare. Throws InputError if one cannot be replayed, or the server cannot
  /// listen.
  ReplayPage(const std::vector<std::filesystem::path>& runs, ServerSettings settings);

  std::string address() const { return server_->address(); }

 private:
  HttpAnswer answer(const HttpRequest& request);

  RecordedRuns runs_;
  std::unique_ptr<Server> server_;
};

}  // namespace incognita
