// Sensors that a scenario chooses, on vehicles that it chooses: what they tell of a point, and how a landmark
// is born from that.
//
// Points have as many numbers as the place has dimensions: 1 on a line, 2 on a plane, 3 in space. A sensor
// that does not tell how far a point is has landmarks born as inverse depths, which become points later.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "incognita/models/any_motion.hpp"
#include "incognita/models/mount.hpp"
#include "incognita/models/stereo_camera.hpp"

namespace incognita {

/// How far along its line a vehicle has a point before it: thesis (3.6).
struct LineScanner {};
/// Range and bearing: thesis (3.19).
struct LaserScanner {};
/// The bearing alone.
struct DirectionFinder {};
/// A camera; a free camera is itself what it is mounted on, and the mount is not used.
struct CarriedCamera {
  Camera camera;
  Mount mount = {};
};
struct CarriedStereo {
  StereoCamera stereo;
  Mount mount = {};
};
using AnySensor = std::variant<LineScanner, LaserScanner, DirectionFinder, CarriedCamera, CarriedStereo>;

/// Why a sensor can not ride on a vehicle; empty when it can.
std::string misfit(const AnyMotion& motion, const AnySensor& sensor);

const Chart& chart_of(const AnySensor& sensor);  ///< of a measurement
int dimensions_of(const AnySensor& sensor);      ///< numbers of a point
bool tells_distance(const AnySensor& sensor);

/// How a landmark is told.
struct LandmarkForm {
  enum class Kind { point, inverse_depth };
  Kind kind = Kind::point;
  Eigen::Vector4d birth_axes{1, 0, 0, 0};  ///< of an inverse depth in space: world_from_birth, a constant
};

struct AnyLook {
  SmallVector z;
  SmallMatrix Hv;       ///< rows x errors of the vehicle
  SmallMatrix Hl;       ///< rows x errors of the landmark
  bool in_view = true;  ///< of a camera: whether its image has the pixel
};

/// Nothing where the sensor has no measurement, as behind a camera. Of motions and sensors that fit.
std::optional<AnyLook> look_at(const AnySensor& sensor, const AnyMotion& motion, const SmallVector& vehicle,
                               const LandmarkForm& form, const SmallVector& landmark);

/// How far and how wide a sensor measures; a camera measures what its image has.
struct Reach {
  double max_range_m = 1e9;
  double field_of_view_rad = 7;  ///< of a scanner, about straight ahead; 7 is more than a full turn
};

/// Whether a sensor with that reach measures a point `distance_m` away that it predicts as `look`.
bool is_in_view(const AnySensor& sensor, const Reach& reach, const AnyLook& look, double distance_m);

struct AnyBirth {
  LandmarkForm form;
  Chart chart;
  SmallVector landmark;
  SmallMatrix Jv;  ///< d(landmark error) / d(vehicle error)
  SmallMatrix Jz;  ///< d(landmark error) / d(measurement)
  SmallVector Jd;  ///< d(landmark error) / d(inverse depth); none where the sensor tells distances
};

/// `inverse_depth` (1/m): the mean before anything is known. Nothing where no point can be made of it.
std::optional<AnyBirth> birth_from(const AnySensor& sensor, const AnyMotion& motion,
                                   const SmallVector& vehicle, const SmallVector& z, double inverse_depth);

/// A place with how it depends on what tells it.
struct AnyPoint {
  SmallVector position;  ///< 1, 2 or 3, m
  SmallMatrix J;         ///< d(position) / d(error)
};
/// Where a vehicle is, in the dimensions of its own motion.
AnyPoint position_of(const AnyMotion& motion, const SmallVector& vehicle);
/// In those of a place: what is on a plane or a line is at 0 in the others.
AnyPoint position_of(const AnyMotion& motion, const SmallVector& vehicle, int dimensions);
/// Where a landmark is. Nothing for one that is at infinity or behind where it was first seen.
std::optional<AnyPoint> position_of(const LandmarkForm& form, const SmallVector& landmark);
/// Civera's: below about 0.1 a point does as well. 0 for a point. `vehicle_position`: in the dimensions of
/// the landmark's place.
double linearity_index(const LandmarkForm& form, const SmallVector& landmark, double inverse_depth_var,
                       const SmallVector& vehicle_position);

}  // namespace incognita
