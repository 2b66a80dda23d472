// The textured surfaces of the rendered room, divided into patches: what there is to be mapped.
//
// Each wall, the floor, the ceiling and each side of a box is divided into equal rectangles whose sides are as near to a given
// size as a whole number of them allows. All of them are painted. A patch counts if a camera can see at least half of it; the
// target's sheet is no part of any patch, since its corners are known from the start. What is seen is found at points about
// 10 cm apart: a point is visible if from one of the given positions of a camera, which span the free space, the ray to it meets
// nothing before, at 10 degrees or more to the surface. Thus the wall behind a box, the floor under it, and the top of a box
// above a camera on a vehicle do not count.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "incognita/models/motion/mount.hpp"
#include "incognita/world/rendered/room.hpp"

namespace incognita {

class SurfacePatches {
 public:
  /// Side of a patch, m: the spacing of landmarks at which a surface counts as mapped. Finer patches would measure how many
  /// landmarks the map has rather than how much of the room is in it: docs/active-navigation.md.
  static constexpr double usual_size_m = 1;

  /// `cameras`: positions of a camera in the free space. Throws std::invalid_argument for a size that is not positive.
  SurfacePatches(std::shared_ptr<const Room> room, const std::vector<Eigen::Vector3d>& cameras,
                 double size_m = usual_size_m);

  /// Of the patches that count: the area of each that a camera can see, m^2. On uneven ground seen from above.
  const std::vector<double>& areas_m2() const { return areas_m2_; }

  /// Index in areas_m2() of the patch on which a point lies; nothing for a point on no surface, on the sheet, or on a patch
  /// that does not count.
  std::optional<std::size_t> patch_at(const Eigen::Vector3d& point) const;

 private:
  /// A rectangle across one axis, divided into columns along the first of the other two axes and rows along the second.
  struct DividedSide {
    int axis = 0;
    double at = 0;           ///< position on that axis, m; not used for uneven ground
    bool faces_up = false;   ///< the visible side faces the upper end of the axis
    bool is_ground = false;  ///< uneven
    Eigen::Vector2d min{0, 0}, max{0, 0};
    int columns = 1, rows = 1;
    std::vector<int> patches = {};  ///< row by row the index in areas_m2_; -1: the patch does not count
  };

  void add_sides(const Box& box, bool from_inside, double size_m);
  void count_patches(DividedSide& side, const std::vector<Eigen::Vector3d>& cameras);
  double area_that_counts(const DividedSide& side, const Eigen::Vector2d& min, const Eigen::Vector2d& size,
                          const std::vector<Eigen::Vector3d>& cameras) const;
  Eigen::Vector3d point_on(const DividedSide& side, const Eigen::Vector2d& at) const;
  Eigen::Vector3d normal_at(const DividedSide& side, const Eigen::Vector3d& point) const;
  bool is_visible(const DividedSide& side, const Eigen::Vector3d& point,
                  const std::vector<Eigen::Vector3d>& cameras) const;
  bool lies_on(const DividedSide& side, const Eigen::Vector3d& point) const;

  std::shared_ptr<const Room> room_;
  std::vector<DividedSide> sides_;
  std::vector<double> areas_m2_;
};

/// Positions of a free camera that keeps its distance from walls and boxes: a grid over the free space.
std::vector<Eigen::Vector3d> free_camera_positions(const Room& room, double clearance_m);

/// Positions of a camera on a vehicle that keeps its distance, at the height of its mount above the ground.
std::vector<Eigen::Vector3d> carried_camera_positions(const Room& room, const Mount& mount,
                                                      double clearance_m);

}  // namespace incognita
