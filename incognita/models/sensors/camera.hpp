// The camera model concept, and a type-erased holder for a model chosen at run time.
//
// A camera model maps a point in camera axes (x right, y down, z forward; any positive scale) to a pixel (u
// right, v down, the center of the first pixel at 0,0), and a pixel back to its ray.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "incognita/math/quaternion.hpp"

namespace incognita {

/// A projection with its Jacobian with respect to the point in camera axes.
struct Projection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> J;  ///< pixels per unit of the point
};

template <class C>
concept CameraModel = requires(const C& camera, const Eigen::Vector3d& point, const Eigen::Vector2d& pixel) {
  { camera.width } -> std::convertible_to<int>;
  { camera.height } -> std::convertible_to<int>;
  /// Whether the projection is defined: in front of the camera and where the distortion is one to one.
  { camera.defined(point) } -> std::same_as<bool>;
  { camera.template h<double>(point) } -> std::convertible_to<Eigen::Vector2d>;
  { camera.project(point) } -> std::same_as<Projection>;
  /// The ray (x, y, 1) through a pixel; nothing when no ray maps to the pixel.
  { camera.unproject(pixel) } -> std::same_as<std::optional<Eigen::Vector3d>>;
  /// Throws std::invalid_argument, naming the invalid parameter.
  { camera.check() } -> std::same_as<void>;
};

/// Any camera model, by value; copies share the immutable model.
class Camera {
 public:
  template <CameraModel C>
  Camera(C model) {  // NOLINT(google-explicit-constructor): implicit conversion to the holder is intended
    model.check();
    self_ = std::make_shared<const Holder<C>>(std::move(model));
  }

  int width() const { return self_->width(); }
  int height() const { return self_->height(); }

  /// Pixel and Jacobian of a point in camera axes; nothing where the model is not defined. The pixel may lie
  /// outside the image: see contains().
  std::optional<Projection> project(const Eigen::Vector3d& point_in_camera) const {
    return self_->project(point_in_camera);
  }

  /// The ray (x, y, 1) through a pixel; nothing when no ray maps to it.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const {
    return self_->unproject(pixel);
  }

  /// Whether a pixel lies in the image, at least `margin` pixels from its border.
  bool contains(const Eigen::Vector2d& pixel, double margin = 0) const {
    return pixel.x() >= margin && pixel.y() >= margin && pixel.x() <= width() - 1 - margin &&
           pixel.y() <= height() - 1 - margin;
  }

 private:
  struct Model {
    virtual ~Model() = default;
    virtual int width() const = 0;
    virtual int height() const = 0;
    virtual std::optional<Projection> project(const Eigen::Vector3d&) const = 0;
    virtual std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d&) const = 0;
  };
  template <CameraModel C>
  struct Holder final : Model {
    explicit Holder(C held) : model(std::move(held)) {}
    int width() const override { return model.width; }
    int height() const override { return model.height; }
    std::optional<Projection> project(const Eigen::Vector3d& point) const override {
      if (!model.defined(point)) return std::nullopt;
      return model.project(point);
    }
    std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const override {
      return model.unproject(pixel);
    }
    C model;
  };
  std::shared_ptr<const Model> self_;
};

}  // namespace incognita
