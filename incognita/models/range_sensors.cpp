#include "incognita/models/range_sensors.hpp"

namespace incognita {

std::string LineScanner::incompatibility(const MotionTraits& motion) {
  return motion.on_line() ? "" : "the scanner of a line belongs to a vehicle on a line";
}

std::string incompatibility_of_scanner(const MotionTraits& motion) {
  switch (motion.space) {
    case Space::line:
      return std::string(line_needs_relative_position);
    case Space::plane:
      return "";
    case Space::uneven_ground:
      return "on uneven ground the plane that a scanner scans tilts with the vehicle: what it measures is no map of "
             "the plane";
    case Space::space:
      return "a scanner of the plane tells nothing of where a body is in space";
  }
  return "";
}

std::optional<AnyLook> DirectionFinder::predict_measurement(const Pose& pose, const LandmarkForm& form,
                                                            const SmallVector& landmark) const {
  const auto as_any = [](const auto& prediction) -> std::optional<AnyLook> {
    if (!prediction) return std::nullopt;
    return AnyLook{prediction->z, prediction->Hv, prediction->Hl};
  };
  if (form.kind == LandmarkForm::Kind::point) return as_any(Bearing::look(pose, Eigen::Vector2d(landmark)));
  return as_any(PlanarInverseDistance::look(pose, PlanarInverseDistance::State<double>(landmark)));
}

std::optional<AnyBirth> DirectionFinder::initialize(const Pose& pose, const SmallVector& z,
                                                    double inverse_depth) const {
  const auto born = PlanarInverseDistance::birth(pose, z[0], inverse_depth);
  return AnyBirth{{LandmarkForm::Kind::inverse_depth, {1, 0, 0, 0}},
                  PlanarInverseDistance::chart,
                  born.landmark,
                  born.Jv,
                  born.Jz.col(0),
                  born.Jz.col(1)};
}

}  // namespace incognita
