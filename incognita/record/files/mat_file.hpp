// Columns of numbers as a MAT file, for Octave and MATLAB.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace incognita {

struct MatFile {
  std::vector<std::pair<std::string, std::vector<double>>> columns;  ///< each a column vector of that name
  std::vector<std::pair<std::string, std::vector<std::string>>>
      words;  ///< each a column cell array of that name
};

/// Characters that a variable's name cannot have become `_`. Level 5, compressed. What was written is read
/// back: when the disk was full, the half file is removed and RecordError thrown.
void write_mat(const std::filesystem::path& path, const MatFile& content);

}  // namespace incognita
