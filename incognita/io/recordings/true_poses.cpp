#include "incognita/io/recordings/true_poses.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <string>
#include <system_error>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/image_names.hpp"
#include "incognita/io/formats/number_table.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

using Matrix34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

/// The upper three rows; a fourth must be 0 0 0 1.
Matrix34 rigid(const std::string& where, const std::vector<double>& numbers) {
  const Matrix34 m = Eigen::Map<const Matrix34>(numbers.data());
  const Eigen::Matrix3d r = m.leftCols<3>();
  if ((r * r.transpose() - Eigen::Matrix3d::Identity()).norm() > 1e-2 || r.determinant() < 0)
    throw InputError(
        fmt::format("{}: must be a rigid transformation, but its upper left 3x3 is not a rotation", where));
  const bool has_last_row = numbers.size() == 16;
  const Eigen::RowVector4d last = has_last_row
                                      ? Eigen::RowVector4d(numbers[12], numbers[13], numbers[14], numbers[15])
                                      : Eigen::RowVector4d(0, 0, 0, 1);
  if (last != Eigen::RowVector4d(0, 0, 0, 1))
    throw InputError(fmt::format("{}: the last row of a 4x4 pose must be 0 0 0 1", where));
  return m;
}

void append_numbers(const TableLine& line, std::size_t columns, std::vector<double>& numbers) {
  if (line.cells.size() != columns)
    throw InputError(
        fmt::format("{}: has {} columns, the lines before have {}", line.where, line.cells.size(), columns));
  for (std::size_t i = 0; i < columns; ++i) numbers.push_back(line.number(i));
}

std::vector<Matrix34> matrices_of_file(const std::filesystem::path& file) {
  const std::vector<TableLine> lines = read_table(file);
  if (lines.empty()) throw InputError(fmt::format("{}: has no poses", shown(file)));
  const std::size_t columns = lines.front().cells.size();
  if (columns != 4 && columns != 12 && columns != 16)
    throw InputError(fmt::format(
        "{}: has {} columns; poses have 8 (t x y z qx qy qz qw), 12 or 16 (a matrix), or 4 (a row of a 4x4 matrix)",
        lines.front().where, columns));
  const std::size_t lines_of_each = columns == 4 ? 4 : 1;
  if (lines.size() % lines_of_each != 0)
    throw InputError(fmt::format("{}: has {} lines, which is not a multiple of the 4 rows of a 4x4 matrix",
                                 shown(file), lines.size()));
  std::vector<Matrix34> matrices;
  for (std::size_t i = 0; i < lines.size(); i += lines_of_each) {
    std::vector<double> numbers;
    for (std::size_t k = 0; k < lines_of_each; ++k) append_numbers(lines[i + k], columns, numbers);
    matrices.push_back(rigid(lines[i].where, numbers));
  }
  return matrices;
}

std::vector<Matrix34> matrices_of_folder(const std::filesystem::path& folder) {
  std::vector<Matrix34> matrices;
  const auto is_text = [](const auto& entry) { return entry.path().extension() == ".txt"; };
  for (const std::string& name : names_in(folder, is_text)) {
    const std::vector<Matrix34> found = matrices_of_file(folder / name);
    if (found.size() != 1)
      throw InputError(fmt::format("{}: has {} matrices; in a folder, each file must have one",
                                   shown(folder / name), found.size()));
    matrices.push_back(found.front());
  }
  return matrices;
}

bool is_tum(const std::filesystem::path& file) {
  const std::vector<TableLine> lines = read_table(file);
  return !lines.empty() && lines.front().cells.size() == 8;
}

bool is_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

}  // namespace

std::vector<RecordedPose> read_tum_poses(const std::filesystem::path& file) {
  std::vector<RecordedPose> poses;
  for (const TableLine& line : read_table(file)) {
    const Eigen::Vector4d q(line.number(7), line.number(4), line.number(5), line.number(6));
    const double t = line.number(0);
    if (std::abs(q.norm() - 1) > 1e-2) {
      throw InputError(fmt::format("{}: columns 5 to 8 must be a unit quaternion, their norm is {}",
                                   line.where, q.norm()));
    }
    if (!poses.empty() && t < poses.back().t) {
      throw InputError(fmt::format("{}: the stamps must not decrease, {} does", line.where, line.text(0)));
    }
    poses.push_back({t, {line.number(1), line.number(2), line.number(3)}, q.normalized()});
  }
  return poses;
}

std::vector<RecordedPose> read_matrix_poses(const std::filesystem::path& path,
                                            const std::vector<Recording::RecordedFrame>& frames) {
  const std::vector<Matrix34> matrices = is_folder(path) ? matrices_of_folder(path) : matrices_of_file(path);
  if (matrices.size() != frames.size())
    throw InputError(fmt::format(
        "{}: has {} matrices for {} images; they have no stamps, so that there must be one per image",
        shown(path), matrices.size(), frames.size()));
  std::vector<RecordedPose> poses;
  for (std::size_t i = 0; i < matrices.size(); ++i)
    poses.push_back({frames[i].t, matrices[i].col(3), quaternion_from_matrix(matrices[i].leftCols<3>())});
  return poses;
}

std::vector<RecordedPose> read_true_poses(const std::filesystem::path& path,
                                          const std::vector<Recording::RecordedFrame>& frames) {
  return !is_folder(path) && is_tum(path) ? read_tum_poses(path) : read_matrix_poses(path, frames);
}

}  // namespace incognita
