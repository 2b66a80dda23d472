// Writes columns of numbers as a MAT file, for Octave and MATLAB.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace incognita {

struct MatFile {
  std::vector<std::pair<std::string, std::vector<double>>> columns;     ///< name and column vector
  std::vector<std::pair<std::string, std::vector<std::string>>> words;  ///< name and column cell array
};

/// Writes a compressed level-5 MAT file. Characters that are not allowed in a variable name become `_`. The
/// file is read back: if it is incomplete (disk full) it is removed and RecordError thrown.
void write_mat(const std::filesystem::path& path, const MatFile& content);

}  // namespace incognita
