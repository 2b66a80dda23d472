// Writes MAT files, and a small car park in the layout of data_set.mat.
#pragma once

#include <gtest/gtest.h>
#include <matio.h>

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace incognita::testing {

using MatVariables = std::map<std::string, Eigen::MatrixXd>;

/// Integers from 0 to 65535 are stored as such, as in the published file; all other numbers as double.
inline void write_mat(const std::filesystem::path& path, const MatVariables& variables,
                      matio_compression compression = MAT_COMPRESSION_NONE) {
  mat_t* mat = Mat_CreateVer(path.c_str(), "by a test", MAT_FT_MAT5);
  ASSERT_TRUE(mat) << path;
  for (const auto& [name, values] : variables) {
    const bool whole =
        (values.array() >= 0 && values.array() <= 65535 && values.array() == values.array().floor()).all();
    Eigen::MatrixXd numbers = values;
    Eigen::Matrix<std::uint16_t, Eigen::Dynamic, Eigen::Dynamic> small;
    if (whole) small = values.cast<std::uint16_t>();
    void* data = whole ? static_cast<void*>(small.data()) : numbers.data();
    std::size_t size[2] = {static_cast<std::size_t>(values.rows()), static_cast<std::size_t>(values.cols())};
    matvar_t* variable = Mat_VarCreate(name.c_str(), whole ? MAT_C_UINT16 : MAT_C_DOUBLE,
                                       whole ? MAT_T_UINT16 : MAT_T_DOUBLE, 2, size, data, 0);
    EXPECT_EQ(Mat_VarWrite(mat, variable, compression), 0) << name;
    Mat_VarFree(variable);
  }
  Mat_Close(mat);
}

inline Eigen::MatrixXd row(const std::vector<double>& values) {
  return Eigen::RowVectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Two fixes, three wheel readings, three scans; the second scan has no detection.
inline MatVariables small_car_park() {
  MatVariables park;
  park["Time"] = row({10, 10.1, 10.2, 10.3, 10.4, 10.5, 10.6, 10.7});
  park["Sensor"] = row({2, 1, 3, 2, 3, 1, 2, 3});
  park["Index"] = row({1, 1, 1, 2, 2, 2, 3, 3});
  park["TimeGPS"] = row({10.1, 10.5});
  park["GPSLon"] = row({5.5, 5.25});
  park["GPSLat"] = row({4.5, 4.125});
  park["Time_VS"] = row({10, 10.3, 10.6});
  park["Velocity"] = row({1.5, -0.25, 2});
  park["Steering"] = row({0.5, -0.5, 0.125});
  park["TimeLaser"] = row({10.2, 10.4, 10.7});
  park["Laser"] = Eigen::MatrixXd::Constant(3, 361, 81.91);
  park["Intensity"] = Eigen::MatrixXd::Zero(3, 361);
  const auto post = [&](int scan, int beam, double range_m) {
    park["Laser"](scan, beam) = range_m;
    park["Intensity"](scan, beam) = 8192;
  };
  post(0, 0, 4.5);
  post(0, 180, 10);
  post(0, 182, 10.5);
  post(2, 360, 20);
  return park;
}

}  // namespace incognita::testing
