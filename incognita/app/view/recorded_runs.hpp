// Recorded runs as the page asks for them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "incognita/live/server.hpp"

namespace incognita {

class RecordedRun;

/// May be used by one thread at a time.
class RecordedRuns {
 public:
  RecordedRuns();
  ~RecordedRuns();

  /// Throws InputError if the folder holds no run.
  void add(const std::filesystem::path& directory);
  /// The same, opened when it is asked for first; `name` is shown before.
  void add_later(const std::filesystem::path& directory, const std::string& name);
  std::size_t size() const { return runs_.size(); }
  std::vector<std::string> names() const;

  /// `what`: the parts of the path after "/api/runs/<index>": "info", "series", "summary", or "frames" and "images" with
  /// a number.
  HttpAnswer answer(std::size_t index, const std::vector<std::string>& what);

 private:
  struct Entry {
    std::filesystem::path directory;
    std::string name;
    std::unique_ptr<RecordedRun> run;
  };
  std::vector<Entry> runs_;
};

}  // namespace incognita
