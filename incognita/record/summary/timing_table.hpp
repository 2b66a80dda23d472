// How long each stage of each frame took. Apart from the rest, because no two runs take the same time.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "incognita/record/files/row_file.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// timings.csv: `t`, then a column of milliseconds per stage. A stage first seen later adds a column: the
/// file is then written anew. Where a frame did not have a stage, its cell is `nan`.
class TimingTable {
 public:
  TimingTable() = default;
  explicit TimingTable(std::filesystem::path path) : path_(std::move(path)) {}

  void add(const Snapshot& snapshot);
  /// Writes what is left, and at least a header.
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
