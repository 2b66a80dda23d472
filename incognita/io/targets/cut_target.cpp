#include "incognita/io/targets/cut_target.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "incognita/vision/corners.hpp"

namespace incognita {
namespace {

constexpr const char* corner_names[] = {"upper left", "upper right", "lower right", "lower left"};
constexpr int refinement_window_px = 15, rounded_px = 3;
constexpr double min_strength =
    20;  // gray levels^2/px^2 (vision/corners.hpp): noise has 1, a corner of dark gray on white thousands
constexpr double max_refinement_px = 4;  // of a corner that was read off by hand
constexpr int cut_patch_px = 15;         // as wide as the start compares: max_patch_size
constexpr int longest_side_px =
    150;  // of the rectangle in its frontal view: more than a camera sees of it when it starts
constexpr int least_side_px = 40;  // in the photograph
constexpr double max_foreshortening = 2.5;
constexpr int largest_picture_px = 100;
constexpr double picture_margin = 0.08;  // of the longer side, where the photograph shows it
constexpr int samples = 3;  // per pixel and direction: a pixel of the frontal view averages its area

[[noreturn]] void refuse_corner(std::size_t i, const Eigen::Vector2d& at, const std::string& why) {
  throw std::invalid_argument(
      fmt::format("corner {} ({}) at ({:g}, {:g}): {}", i, corner_names[i], at.x(), at.y(), why));
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - b).y() - (b - a).y() * (c - b).x();
}

/// v is down: corners are clockwise if every turn is positive.
void check_order(const std::array<Eigen::Vector2d, 4>& c) {
  int clockwise = 0, counterclockwise = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double area = turn(c[i], c[(i + 1) % 4], c[(i + 2) % 4]);
    clockwise += area > 0 ? 1 : 0, counterclockwise += area < 0 ? 1 : 0;
  }
  constexpr const char* remedy = "give them clockwise: upper left, upper right, lower right, lower left";
  if (counterclockwise == 4)
    throw std::invalid_argument(std::string("the corners are counterclockwise: ") + remedy);
  if (clockwise != 4)
    throw std::invalid_argument(std::string("the corners are no convex quadrilateral in this order: ") +
                                remedy);
}

Eigen::Vector2d refined_corner(const Image& photograph, const std::array<Eigen::Vector2d, 4>& corners,
                               std::size_t i, std::vector<std::string>& notes) {
  const Eigen::Vector2d& at = corners[i];
  const double margin = refinement_window_px / 2 + 1.0;
  if (!(at.x() >= margin && at.y() >= margin && at.x() <= photograph.width() - 1 - margin &&
        at.y() <= photograph.height() - 1 - margin))
    refuse_corner(i, at,
                  fmt::format("must be inside the photograph of {}x{} px, {} px or more from its border",
                              photograph.width(), photograph.height(), margin));
  const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y()),
            near = static_cast<int>(max_refinement_px);
  const auto strongest =
      strongest_corner(photograph, {u - near, v - near, 2 * near + 1, 2 * near + 1}, near + 1);
  const auto found = center_of_corner(photograph, at, refinement_window_px, rounded_px);
  if (!strongest || strongest->strength < min_strength || !found || (*found - at).norm() > max_refinement_px)
    refuse_corner(
        i, at,
        fmt::format(
            "no two edges meet within {} px; read the pixel of the corner again, or take a corner with more contrast",
            max_refinement_px));
  notes.push_back(fmt::format("corner {} ({}) is at ({:.2f}, {:.2f}), {:.1f} px from where it was given", i,
                              corner_names[i], found->x(), found->y(), (*found - at).norm()));
  return *found;
}

/// The mapping that takes (x, y) on the target to the ray (u, v, 1) or pixel of each corner (direct linear transformation).
Eigen::Matrix3d homography(const std::array<Eigen::Vector2d, 4>& from,
                           const std::array<Eigen::Vector2d, 4>& to) {
  Eigen::Matrix<double, 8, 9> A = Eigen::Matrix<double, 8, 9>::Zero();
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = from[static_cast<std::size_t>(i)].homogeneous();
    const Eigen::Vector2d& q = to[static_cast<std::size_t>(i)];
    A.block<1, 3>(2 * i, 0) = p.transpose(), A.block<1, 3>(2 * i, 6) = -q.x() * p.transpose();
    A.block<1, 3>(2 * i + 1, 3) = p.transpose(), A.block<1, 3>(2 * i + 1, 6) = -q.y() * p.transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix<double, 8, 9>> svd(A, Eigen::ComputeFullV);
  const Eigen::Vector<double, 9> h = svd.matrixV().col(8);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(h.data());
}

/// Pixels of the photograph by points on the target, m from its center.
class Plane {
 public:
  Plane(const TargetCut& cut, const std::array<Eigen::Vector2d, 4>& corners_px) : camera_(cut.camera) {
    const double x = cut.width_m / 2, y = cut.height_m / 2;
    corners_m = {{{-x, -y}, {x, -y}, {x, y}, {-x, y}}};
    std::array<Eigen::Vector2d, 4> seen = corners_px;
    for (std::size_t i = 0; camera_ && i < 4; ++i) {
      const auto ray = camera_->unproject(corners_px[i]);
      if (!ray)
        refuse_corner(i, corners_px[i],
                      "the camera has no ray for this pixel: is the calibration that of the photograph?");
      seen[i] = ray->head<2>();
    }
    seen_from_plane_ = homography(corners_m, seen);
  }

  std::optional<Eigen::Vector2d> pixel_of(const Eigen::Vector2d& at_m) const {
    const Eigen::Vector3d seen = seen_from_plane_ * at_m.homogeneous();
    if (std::abs(seen.z()) < 1e-12) return std::nullopt;
    const Eigen::Vector2d at = seen.hnormalized();
    if (!camera_) return at;
    const auto projected = camera_->project({at.x(), at.y(), 1});
    return projected ? std::optional(projected->pixel) : std::nullopt;
  }

  std::array<Eigen::Vector2d, 4> corners_m;

 private:
  std::optional<Camera> camera_;
  Eigen::Matrix3d seen_from_plane_;
};

bool is_inside(const Image& image, const std::optional<Eigen::Vector2d>& pixel) {
  return pixel && pixel->x() >= 0 && pixel->y() >= 0 && pixel->x() <= image.width() - 1 &&
         pixel->y() <= image.height() - 1;
}

/// A view from the front: the center of the first pixel is at `first_m`. Nothing if the photograph does not show all of it.
std::optional<Image> frontal(const Image& photograph, const Plane& plane, const Eigen::Vector2d& first_m,
                             double px_per_m, int width, int height) {
  Image view(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      double sum = 0;
      for (int i = 0; i < samples * samples; ++i) {
        const Eigen::Vector2d within((i % samples + 0.5) / samples - 0.5,
                                     (i / samples + 0.5) / samples - 0.5);
        const auto pixel = plane.pixel_of(first_m + (Eigen::Vector2d(u, v) + within) / px_per_m);
        if (!is_inside(photograph, pixel)) return std::nullopt;
        sum += photograph.sample(pixel->x(), pixel->y());
      }
      view(u, v) = static_cast<std::uint8_t>(std::lround(sum / (samples * samples)));
    }
  return view;
}

/// Pixels per meter of the patches: those of the photograph, or less. Refuses a rectangle that is too small or too oblique.
double scale_of(const std::array<Eigen::Vector2d, 4>& c, const TargetCut& cut) {
  const double sides[] = {(c[1] - c[0]).norm() / cut.width_m, (c[2] - c[1]).norm() / cut.height_m,
                          (c[3] - c[2]).norm() / cut.width_m, (c[0] - c[3]).norm() / cut.height_m};
  for (std::size_t i = 0; i < 4; ++i)
    if ((c[(i + 1) % 4] - c[i]).norm() < least_side_px)
      throw std::invalid_argument(fmt::format(
          "the side from corner {} to {} is {:.0f} px long, and must be {}: photograph it from nearer", i,
          (i + 1) % 4, (c[(i + 1) % 4] - c[i]).norm(), least_side_px));
  const auto [least, most] = std::minmax_element(std::begin(sides), std::end(sides));
  if (*most > max_foreshortening * *least)
    throw std::invalid_argument(fmt::format(
        "by --size its sides have {:.0f} to {:.0f} px per m in the photograph, a ratio above {}: is the size right (width x height)? Else photograph it more from the front",
        *least, *most, max_foreshortening));
  return std::min(*least, longest_side_px / std::max(cut.width_m, cut.height_m));
}

/// Also the surroundings, where the photograph shows them.
void add_picture(const Image& photograph, const Plane& plane, const TargetCut& cut, CutTarget& out) {
  const double longer_m = std::max(cut.width_m, cut.height_m);
  for (const double margin : {picture_margin, picture_margin / 2, 0.0}) {
    const double width_m = cut.width_m + 2 * margin * longer_m,
                 height_m = cut.height_m + 2 * margin * longer_m;
    const double px_per_m = largest_picture_px / std::max(width_m, height_m);
    const int width = static_cast<int>(width_m * px_per_m), height = static_cast<int>(height_m * px_per_m);
    const Eigen::Vector2d first_m = -0.5 / px_per_m * Eigen::Vector2d(width - 1, height - 1);
    const auto picture = frontal(photograph, plane, first_m, px_per_m, width, height);
    if (!picture) continue;
    out.target.picture = *picture;
    for (NewTarget::Corner& corner : out.target.corners) {
      corner.picture_px = (corner.position_m - first_m) * px_per_m;
      corner.picture_px = corner.picture_px.cwiseMax(0).cwiseMin(Eigen::Vector2d(width - 1, height - 1));
    }
    out.notes.push_back(fmt::format("picture of {}x{} px, with a margin of {:.0f} % of the longer side",
                                    width, height, 100 * margin));
    return;
  }
  throw std::invalid_argument("the photograph must show the whole rectangle");
}

}  // namespace

CutTarget cut_target(const Image& photograph, const TargetCut& cut) {
  CutTarget out;
  for (std::size_t i = 0; i < 4; ++i)
    if (const Eigen::Vector2d& at = cut.corners_px[i];
        !(at.x() >= 0 && at.y() >= 0 && at.x() < photograph.width() && at.y() < photograph.height()))
      refuse_corner(
          i, at,
          fmt::format("is outside of the photograph of {}x{} px", photograph.width(), photograph.height()));
  check_order(cut.corners_px);
  scale_of(cut.corners_px, cut);  // refuses what is too small or too oblique
  std::array<Eigen::Vector2d, 4> corners_px;
  for (std::size_t i = 0; i < 4; ++i)
    corners_px[i] = refined_corner(photograph, cut.corners_px, i, out.notes);
  const double px_per_m = scale_of(corners_px, cut);
  const Plane plane(cut, corners_px);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d first_m = plane.corners_m[i].array() - (cut_patch_px / 2) / px_per_m;
    const auto patch = frontal(photograph, plane, first_m, px_per_m, cut_patch_px, cut_patch_px);
    if (!patch)
      refuse_corner(
          i, corners_px[i],
          fmt::format("its patch of {} mm is not all in the photograph; show more of the surroundings",
                      std::lround(1000 * cut_patch_px / px_per_m)));
    out.target.corners.push_back({plane.corners_m[i], *patch, {}});
  }
  out.notes.push_back(
      fmt::format("patches of {}x{} px, {:.2g} mm each", cut_patch_px, cut_patch_px, 1000 / px_per_m));
  add_picture(photograph, plane, cut, out);
  return out;
}

}  // namespace incognita
