#include "incognita/io/formats/mat_numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <matio.h>

#include <memory>
#include <optional>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/mat_structure.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::size_t largest_file = std::size_t{256} << 20;
constexpr std::size_t best_compression = 1032;  // largest compression ratio of deflate

struct CloseMat {
  void operator()(mat_t* mat) const { Mat_Close(mat); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Mat = std::unique_ptr<mat_t, CloseMat>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

template <class T>
std::optional<Eigen::MatrixXd> converted(const matvar_t& variable) {
  const std::size_t rows = variable.dims[0], columns = variable.dims[1];
  Eigen::MatrixXd numbers(rows, columns);
  if (rows * columns == 0) return numbers;
  if (!variable.data || variable.nbytes != rows * columns * sizeof(T)) return std::nullopt;
  const T* stored = static_cast<const T*>(variable.data);
  for (Eigen::Index i = 0; i < numbers.size(); ++i) numbers(i) = static_cast<double>(stored[i]);
  return numbers;
}

std::optional<Eigen::MatrixXd> as_double(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return converted<double>(variable);
    case MAT_C_SINGLE:
      return converted<float>(variable);
    case MAT_C_INT8:
      return converted<std::int8_t>(variable);
    case MAT_C_UINT8:
      return converted<std::uint8_t>(variable);
    case MAT_C_INT16:
      return converted<std::int16_t>(variable);
    case MAT_C_UINT16:
      return converted<std::uint16_t>(variable);
    case MAT_C_INT32:
      return converted<std::int32_t>(variable);
    case MAT_C_UINT32:
      return converted<std::uint32_t>(variable);
    case MAT_C_INT64:
      return converted<std::int64_t>(variable);
    case MAT_C_UINT64:
      return converted<std::uint64_t>(variable);
    default:
      return std::nullopt;
  }
}

[[noreturn]] void refuse_missing(mat_t* mat, const std::string& file, const std::string& name) {
  std::size_t count = 0;
  char** const directory = Mat_GetDir(mat, &count);
  const std::vector<std::string> there(directory, directory + (directory ? count : 0));
  throw InputError(fmt::format("{}: there is no variable `{}`; it has {}; the nearest is `{}`", file, name,
                               fmt::format("{}", fmt::join(there, ", ")).substr(0, 400),
                               nearest_name(name, there)));
}

Eigen::MatrixXd read_variable(mat_t* mat, const std::string& file, std::size_t file_size,
                              const std::string& name) {
  const Variable variable(Mat_VarReadInfo(mat, name.c_str()));
  if (!variable) refuse_missing(mat, file, name);
  const bool flat = variable->rank == 2 && variable->dims;
  const bool number = variable->class_type >= MAT_C_DOUBLE && variable->class_type <= MAT_C_UINT64;
  if (!flat || !number || variable->isComplex) {
    throw InputError(fmt::format("{}: `{}` must be a matrix of real numbers", file, name));
  }
  const std::size_t rows = variable->dims[0], columns = variable->dims[1];
  const std::size_t most = best_compression * file_size;
  if (columns != 0 && rows > most / columns) {
    throw InputError(fmt::format("{}: `{}` is {}x{}, more than the file can hold; it is damaged", file, name,
                                 rows, columns));
  }
  if (Mat_VarReadDataAll(mat, variable.get()) == 0) {
    if (std::optional<Eigen::MatrixXd> numbers = as_double(*variable)) return *std::move(numbers);
  }
  throw InputError(fmt::format("{}: `{}` cannot be read; the file is damaged, copy it again", file, name));
}

}  // namespace

std::map<std::string, Eigen::MatrixXd> read_mat_numbers(const std::filesystem::path& file,
                                                        const std::vector<std::string>& names) {
  std::size_t size = 0;
  {
    const std::string bytes = read_file(file, largest_file);
    check_mat_structure(bytes, file.string());
    size = bytes.size();
  }
  const Mat mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY));
  if (!mat) throw InputError(file.string() + ": is not a MAT file that can be read");
  std::map<std::string, Eigen::MatrixXd> found;
  for (const std::string& name : names) found[name] = read_variable(mat.get(), file.string(), size, name);
  return found;
}

}  // namespace incognita
