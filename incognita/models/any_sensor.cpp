#include "incognita/models/any_sensor.hpp"

#include <algorithm>
#include <stdexcept>

#include "incognita/models/bearing.hpp"
#include "incognita/models/range_bearing.hpp"

namespace incognita {
namespace {

template <class... F>
struct Cases : F... {
  using F::operator()...;
};
template <class... F>
Cases(F...) -> Cases<F...>;

bool on_line(const AnyMotion& motion) { return std::holds_alternative<MonobotMotion>(motion); }
bool on_plane(const AnyMotion& motion) {
  return std::holds_alternative<DifferentialDrive>(motion) || std::holds_alternative<AckermannCar>(motion);
}
bool is_camera(const AnySensor& sensor) {
  return std::holds_alternative<CarriedCamera>(sensor) || std::holds_alternative<CarriedStereo>(sensor);
}

const Mount& mount_of(const AnySensor& sensor) {
  if (const auto* camera = std::get_if<CarriedCamera>(&sensor)) return camera->mount;
  return std::get<CarriedStereo>(sensor).mount;
}

/// A camera's pose, and how its six errors depend on the vehicle's.
struct Seat {
  CameraState camera;
  SmallMatrix J;
};

template <int errors>
Seat seat_on(const Mount& mount, const PoseOf<errors>& body) {
  const MountedCamera<errors> mounted = mount.on(body);
  return {mounted.camera, mounted.J};
}

Seat seat_of(const AnySensor& sensor, const AnyMotion& motion, const SmallVector& x) {
  return std::visit(
      Cases{[&](const TerrainVehicle& vehicle) {
              return seat_on(mount_of(sensor), vehicle.pose(TerrainVehicle::State<double>(x)));
            },
            [&](const FreeCameraMotion&) {
              Seat seat{CameraState(x), SmallMatrix::Zero(6, FreeCameraMotion::error_size)};
              seat.J.leftCols(6).setIdentity();
              return seat;
            },
            [&](const MonobotMotion&) -> Seat { throw std::logic_error("a camera on a line"); },
            [&](const auto&) { return seat_on(mount_of(sensor), on_floor(planar::Pose<double>(x))); }},
      motion);
}

template <int rows>
SmallMatrix through(const Eigen::Matrix<double, rows, FreeCameraMotion::error_size>& by_camera,
                    const Seat& seat) {
  return by_camera.template leftCols<6>() * seat.J;
}

template <class Look>
std::optional<AnyLook> any(const std::optional<Look>& look) {
  if (!look) return std::nullopt;
  return AnyLook{look->z, look->Hv, look->Hl};
}

std::optional<AnyLook> look_of_camera(const Camera& camera, const Seat& seat, const LandmarkForm& form,
                                      const SmallVector& landmark) {
  const auto told = [&](const auto& look) -> std::optional<AnyLook> {
    if (!look) return std::nullopt;
    return AnyLook{look->pixel, through(look->Hv, seat), look->Hl, camera.contains(look->pixel)};
  };
  if (form.kind == LandmarkForm::Kind::point)
    return told(PointLandmark::look(camera, seat.camera, Eigen::Vector3d(landmark)));
  return told(
      InverseDepthLandmark{form.birth_axes}.look(camera, seat.camera, InverseDepthLandmark::State(landmark)));
}

}  // namespace

std::string misfit(const AnyMotion& motion, const AnySensor& sensor) {
  if (std::holds_alternative<LineScanner>(sensor) != on_line(motion))
    return on_line(motion)
               ? "a vehicle on a line sees how far along it a point is, and nothing else: a bearing "
                 "says nothing there, and an image has one column"
               : "the scanner of a line belongs to a vehicle on a line";
  if (is_camera(sensor) || on_line(motion)) return "";
  if (std::holds_alternative<FreeCameraMotion>(motion))
    return "a scanner of the plane tells nothing of where a body is in space";
  if (std::holds_alternative<TerrainVehicle>(motion))
    return "on uneven ground the plane that a scanner scans tilts with the vehicle: what it measures is no "
           "map of "
           "the plane";
  return "";
}

const Chart& chart_of(const AnySensor& sensor) {
  static constexpr Chart one = Chart::line(1), pixel = Chart::line(2), two_views = Chart::line(3);
  return *std::visit(
      Cases{[](const LineScanner&) { return &one; }, [](const LaserScanner&) { return &RangeBearing::chart; },
            [](const DirectionFinder&) { return &Bearing::chart; },
            [](const CarriedCamera&) { return &pixel; }, [](const CarriedStereo&) { return &two_views; }},
      sensor);
}

int dimensions_of(const AnySensor& sensor) {
  return is_camera(sensor) ? 3 : std::holds_alternative<LineScanner>(sensor) ? 1 : 2;
}

bool tells_distance(const AnySensor& sensor) {
  return !std::holds_alternative<DirectionFinder>(sensor) && !std::holds_alternative<CarriedCamera>(sensor);
}

std::optional<AnyLook> look_at(const AnySensor& sensor, const AnyMotion& motion, const SmallVector& vehicle,
                               const LandmarkForm& form, const SmallVector& landmark) {
  return std::visit(
      Cases{[&](const LineScanner&) -> std::optional<AnyLook> {
              const auto look = RelativePosition::look(vehicle[0], landmark[0]);
              return AnyLook{look.z, look.Hv, look.Hl};
            },
            [&](const LaserScanner&) {
              return any(RangeBearing::look(planar::Pose<double>(vehicle), Eigen::Vector2d(landmark)));
            },
            [&](const DirectionFinder&) {
              const planar::Pose<double> pose = vehicle;
              if (form.kind == LandmarkForm::Kind::point)
                return any(Bearing::look(pose, Eigen::Vector2d(landmark)));
              return any(PlanarInverseDistance::look(pose, PlanarInverseDistance::State<double>(landmark)));
            },
            [&](const CarriedCamera& carried) {
              return look_of_camera(carried.camera, seat_of(sensor, motion, vehicle), form, landmark);
            },
            [&](const CarriedStereo& carried) -> std::optional<AnyLook> {
              const Seat seat = seat_of(sensor, motion, vehicle);
              const auto told = [&](const auto& look) -> std::optional<AnyLook> {
                if (!look) return std::nullopt;
                return AnyLook{look->z, through(look->Hv, seat), look->Hl, carried.stereo.contains(*look)};
              };
              if (form.kind == LandmarkForm::Kind::point)
                return told(carried.stereo.look(seat.camera, Eigen::Vector3d(landmark)));
              return told(carried.stereo.look(seat.camera, InverseDepthLandmark{form.birth_axes},
                                              InverseDepthLandmark::State(landmark)));
            }},
      sensor);
}

bool is_in_view(const AnySensor& sensor, const Reach& reach, const AnyLook& look, double distance_m) {
  if (!look.in_view || !(distance_m <= reach.max_range_m)) return false;
  const bool has_bearing =
      std::holds_alternative<LaserScanner>(sensor) || std::holds_alternative<DirectionFinder>(sensor);
  return !has_bearing || std::abs(look.z[look.z.size() - 1]) <= reach.field_of_view_rad / 2;
}

namespace {

std::optional<AnyBirth> birth_in_space(const CarriedCamera& carried, const Seat& seat, const SmallVector& z,
                                       double inverse_depth) {
  const auto born =
      InverseDepthLandmark::birth(carried.camera, seat.camera, Eigen::Vector2d(z), inverse_depth);
  if (!born) return std::nullopt;
  AnyBirth birth{{LandmarkForm::Kind::inverse_depth, born->world_from_birth},
                 InverseDepthLandmark::chart,
                 born->landmark,
                 through(born->Jv, seat),
                 born->Jz,
                 SmallVector::Unit(6, 5)};
  return birth;
}

}  // namespace

std::optional<AnyBirth> birth_from(const AnySensor& sensor, const AnyMotion& motion,
                                   const SmallVector& vehicle, const SmallVector& z, double inverse_depth) {
  return std::visit(
      Cases{[&](const LineScanner&) -> std::optional<AnyBirth> {
              const auto born = RelativePosition::birth(vehicle[0], z[0]);
              return AnyBirth{{}, Chart::line(1), born.landmark, born.Jv, born.Jz, {}};
            },
            [&](const LaserScanner&) -> std::optional<AnyBirth> {
              const auto born = RangeBearing::birth(planar::Pose<double>(vehicle), Eigen::Vector2d(z));
              return AnyBirth{{}, RangeBearing::landmark_chart, born.landmark, born.Jv, born.Jz, {}};
            },
            [&](const DirectionFinder&) -> std::optional<AnyBirth> {
              const auto born =
                  PlanarInverseDistance::birth(planar::Pose<double>(vehicle), z[0], inverse_depth);
              return AnyBirth{{LandmarkForm::Kind::inverse_depth, {1, 0, 0, 0}},
                              PlanarInverseDistance::chart,
                              born.landmark,
                              born.Jv,
                              born.Jz.col(0),
                              born.Jz.col(1)};
            },
            [&](const CarriedCamera& carried) {
              return birth_in_space(carried, seat_of(sensor, motion, vehicle), z, inverse_depth);
            },
            [&](const CarriedStereo& carried) -> std::optional<AnyBirth> {
              const Seat seat = seat_of(sensor, motion, vehicle);
              const auto born = carried.stereo.distant_birth(seat.camera, Eigen::Vector3d(z));
              if (!born) return std::nullopt;
              return AnyBirth{{LandmarkForm::Kind::inverse_depth, born->form.world_from_birth},
                              InverseDepthLandmark::chart,
                              born->landmark,
                              through(born->Jv, seat),
                              born->Jz,
                              {}};
            }},
      sensor);
}

AnyPoint position_of(const AnyMotion& motion, const SmallVector& vehicle) {
  const int errors = chart_of(motion).tangent();
  if (const auto* terrain = std::get_if<TerrainVehicle>(&motion)) {
    const PoseOf<3> body = terrain->pose(TerrainVehicle::State<double>(vehicle));
    return {body.pose.position, body.J.topRows<3>()};
  }
  const int size = on_line(motion) ? 1 : on_plane(motion) ? 2 : 3;
  return {vehicle.head(size), SmallMatrix::Identity(size, errors)};
}

AnyPoint position_of(const AnyMotion& motion, const SmallVector& vehicle, int dimensions) {
  const AnyPoint own = position_of(motion, vehicle);
  const Eigen::Index both = std::min<Eigen::Index>(dimensions, own.position.size());
  AnyPoint at{SmallVector::Zero(dimensions), SmallMatrix::Zero(dimensions, own.J.cols())};
  at.position.head(both) = own.position.head(both);
  at.J.topRows(both) = own.J.topRows(both);
  return at;
}

std::optional<AnyPoint> position_of(const LandmarkForm& form, const SmallVector& landmark) {
  if (form.kind == LandmarkForm::Kind::point)
    return AnyPoint{landmark, SmallMatrix::Identity(landmark.size(), landmark.size())};
  if (!(landmark[landmark.size() - 1] > 0)) return std::nullopt;
  if (landmark.size() == PlanarInverseDistance::size) {
    const auto point = PlanarInverseDistance::point(PlanarInverseDistance::State<double>(landmark));
    return AnyPoint{point.position, point.J};
  }
  const auto point = InverseDepthLandmark{form.birth_axes}.point(InverseDepthLandmark::State(landmark));
  return AnyPoint{point.position, point.J};
}

double linearity_index(const LandmarkForm& form, const SmallVector& landmark, double inverse_depth_var,
                       const SmallVector& vehicle_position) {
  if (form.kind == LandmarkForm::Kind::point) return 0;
  if (landmark.size() == PlanarInverseDistance::size)
    return PlanarInverseDistance::linearity_index(PlanarInverseDistance::State<double>(landmark),
                                                  inverse_depth_var, Eigen::Vector2d(vehicle_position));
  return InverseDepthLandmark{form.birth_axes}.linearity_index(
      InverseDepthLandmark::State(landmark), inverse_depth_var, Eigen::Vector3d(vehicle_position));
}

}  // namespace incognita
