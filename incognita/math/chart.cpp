#include "incognita/math/chart.hpp"

#include "incognita/math/angles.hpp"
#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

using Quaternion = Eigen::Map<const Eigen::Vector4d>;
using Rotation = Eigen::Map<const Eigen::Vector3d>;

}  // namespace

void Chart::plus(std::span<double> x, std::span<const double> delta) const {
  double* to = x.data();
  const double* from = delta.data();
  for (int i = 0; i < count_; ++i) {
    const Part& part = parts_[i];
    if (part.kind == Kind::quaternion) {
      const Eigen::Vector4d q =
          quaternion_product<double>(Quaternion(to), quaternion_exp<double>(Rotation(from)));
      Eigen::Map<Eigen::Vector4d>{to} = q.normalized();
      from += 3;
    } else {
      for (int k = 0; k < part.size; ++k) {
        to[k] += from[k];
        if (part.kind == Kind::angle) to[k] = wrap_angle(to[k]);
      }
      from += part.size;
    }
    to += part.size;
  }
}

void Chart::minus(std::span<const double> y, std::span<const double> x, std::span<double> delta) const {
  const double* a = y.data();
  const double* b = x.data();
  double* to = delta.data();
  for (int i = 0; i < count_; ++i) {
    const Part& part = parts_[i];
    if (part.kind == Kind::quaternion) {
      const Eigen::Vector4d q =
          quaternion_product<double>(quaternion_conjugate<double>(Quaternion(b)), Quaternion(a));
      Eigen::Map<Eigen::Vector3d>{to} = quaternion_log(q);
      to += 3;
    } else {
      for (int k = 0; k < part.size; ++k)
        to[k] = part.kind == Kind::angle ? wrap_angle(a[k] - b[k]) : a[k] - b[k];
      to += part.size;
    }
    a += part.size;
    b += part.size;
  }
}

}  // namespace incognita
