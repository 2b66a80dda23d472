#include "incognita/record/files/mat_file.hpp"

#include <matio.h>

#include <cctype>
#include <cerrno>
#include <memory>
#include <system_error>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/row_file.hpp"

namespace incognita {
namespace {

struct CloseMat {
  void operator()(mat_t* mat) const { Mat_Close(mat); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Mat = std::unique_ptr<mat_t, CloseMat>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

std::string variable_name(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name.substr(0, 63);
}

Variable column(const std::string& name, const std::vector<double>& values) {
  std::size_t size[2] = {values.size(), 1};
  return Variable(Mat_VarCreate(variable_name(name).c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size,
                                const_cast<double*>(values.data()), 0));  // MatIO copies the data
}

Variable cells(const std::string& name, const std::vector<std::string>& words) {
  std::size_t size[2] = {words.size(), 1};
  Variable cell(Mat_VarCreate(variable_name(name).c_str(), MAT_C_CELL, MAT_T_CELL, 2, size, nullptr, 0));
  for (std::size_t i = 0; cell && i < words.size(); ++i) {
    std::size_t length[2] = {1, words[i].size()};
    Mat_VarSetCell(
        cell.get(), static_cast<int>(i),
        Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, length, const_cast<char*>(words[i].data()), 0));
  }
  return cell;
}

bool write(mat_t* mat, const Variable& variable) {
  return variable && Mat_VarWrite(mat, variable.get(), MAT_COMPRESSION_ZLIB) == 0;
}

bool write_all(const std::filesystem::path& path, const MatFile& content) {
  const Mat mat(Mat_CreateVer(
      path.c_str(), "incognita run: one variable per column of series.csv and timings.csv", MAT_FT_MAT5));
  if (!mat) return false;
  for (const auto& [name, values] : content.columns)
    if (!write(mat.get(), column(name, values))) return false;
  for (const auto& [name, words] : content.words)
    if (!write(mat.get(), cells(name, words))) return false;
  return true;
}

/// MatIO ignores the result of closing the file, so completeness can only be checked by reading it back.
bool complete(const std::filesystem::path& path, const MatFile& content) {
  const Mat mat(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!mat) return false;
  for (const auto& [name, values] : content.columns) {
    const Variable variable(Mat_VarRead(mat.get(), variable_name(name).c_str()));
    if (!variable || variable->dims[0] != values.size() || (!values.empty() && !variable->data)) return false;
  }
  for (const auto& [name, words] : content.words) {
    const Variable variable(Mat_VarReadInfo(mat.get(), variable_name(name).c_str()));
    if (!variable || variable->dims[0] != words.size()) return false;
  }
  return true;
}

}  // namespace

void write_mat(const std::filesystem::path& path, const MatFile& content) {
  errno = 0;
  const bool written = write_all(path, content);
  const int error = errno;
  if (written && complete(path, content)) return;
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  throw RecordError(write_failure(path, error != 0 ? error : EIO));
}

}  // namespace incognita
