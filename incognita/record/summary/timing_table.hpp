// Computation time of each stage of each frame; in a file of its own because it differs between runs.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "incognita/record/files/row_file.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// timings.csv: `t`, then a column of milliseconds per stage. A stage that appears later adds a column, and
/// the file is rewritten. The cell is `nan` if a frame did not have a stage.
class TimingTable {
 public:
  TimingTable() = default;
  explicit TimingTable(std::filesystem::path path) : path_(std::move(path)) {}

  void add(const Snapshot& snapshot);
  /// Writes the remaining rows, and at least a header.
  void close();

  const std::vector<std::string>& stages() const { return stages_; }
  /// Milliseconds of one stage in all frames.
  std::vector<double> column(std::size_t stage) const;

 private:
  bool set_stages(const Snapshot& snapshot);
  void open();
  std::string row(std::size_t frame) const;

  std::filesystem::path path_;
  std::vector<std::string> stages_;
  std::vector<std::pair<double, std::vector<double>>> frames_;  ///< t, ms of the stages known then
  RowFile file_;
};

}  // namespace incognita
