// Charts: addition of a small error to a state, and the difference of two states.
//
// A state block is stored as `ambient` numbers, and its covariance has `tangent` rows. The two differ on a
// manifold: a unit quaternion has 4 numbers and 3 errors. A chart is a short list of parts, each with its own
// addition and difference, so that angle differences are wrapped and quaternions stay normalized.
#pragma once

#include <array>
#include <initializer_list>
#include <span>

namespace incognita {

class StateArchive;

class Chart {
 public:
  enum class Kind : unsigned char {
    line,        ///< `size` plain numbers
    angle,       ///< one angle in radians, differences wrapped to (-pi, pi]
    quaternion,  ///< w,x,y,z; error e (3, radians, body frame): q = q_mean * exp(e/2)
  };
  struct Part {
    Kind kind = Kind::line;
    int size = 0;  ///< numbers stored for this part
  };
  static constexpr int max_parts = 4;

  constexpr Chart(std::initializer_list<Part> parts) {
    for (const Part& part : parts) {
      parts_[count_++] = part;
      ambient_ += part.size;
      tangent_ += part.kind == Kind::quaternion ? 3 : part.size;
    }
  }
  static constexpr Chart line(int size) { return Chart{{Kind::line, size}}; }

  constexpr int ambient() const { return ambient_; }
  constexpr int tangent() const { return tangent_; }

  /// x <- x (+) delta. `x` has ambient() numbers, `delta` tangent().
  void plus(std::span<double> x, std::span<const double> delta) const;

  /// delta = y (-) x, such that x (+) delta = y. Sizes as in plus().
  void minus(std::span<const double> y, std::span<const double> x, std::span<double> delta) const;

  /// Saves or restores the parts: saved_state/.
  void state(StateArchive& archive);

 private:
  std::array<Part, max_parts> parts_{};
  int count_ = 0;
  int ambient_ = 0;
  int tangent_ = 0;
};

}  // namespace incognita
