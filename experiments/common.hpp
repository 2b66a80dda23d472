// What nearly every experiment uses: its declaration, claims with their verdicts, independent runs and numbers
// of them, plots, formatted text, matrices, angles and chance.
#pragma once

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "experiments/cases.hpp"
#include "experiments/compared_numbers.hpp"
#include "experiments/curves.hpp"
#include "experiments/entry.hpp"
#include "experiments/evidence.hpp"
#include "experiments/list.hpp"
#include "experiments/seeds.hpp"
#include "experiments/worst.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/math/random.hpp"
#include "incognita/report/plot.hpp"

namespace incognita {

using Eigen::Index, Eigen::Matrix2d, Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector2d, Eigen::Vector3d,
    Eigen::VectorXd;
using std::numbers::pi;

}  // namespace incognita
