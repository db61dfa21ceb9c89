// Obstacles at rest or in motion: sites that they cover, and cuts of the links between sites.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace polybed::multiscale::lattice {

using Point = std::array<double, 3>;  ///< in cells

/// Sites of a periodic box plus one layer around it: site (i, j, k) of the array is at (i - 1, j - 1, k - 1) in the
/// box.
struct Sites {
  std::array<int, 3> box{};  ///< sites
  std::size_t row = 0;       ///< length of a row along z in memory

  [[nodiscard]] std::size_t at(int i, int j, int k) const {
    return (std::size_t(i) * std::size_t(box[1] + 2) + std::size_t(j)) * row + std::size_t(k);
  }
  /// The inverse of at().
  [[nodiscard]] std::array<int, 3> place(std::size_t site) const {
    const std::size_t plane = std::size_t(box[1] + 2) * row;
    return {int(site / plane), int(site % plane / row), int(site % row)};
  }
  /// Vector to a site from the nearest image of a centre.
  [[nodiscard]] Point from(const Point& centre, std::size_t site) const {
    const std::array<int, 3> at = place(site);
    Point arm;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = at[k] - 1 - centre[k];
      arm[k] = d - box[k] * std::round(d / box[k]);
    }
    return arm;
  }
  /// Whether it is inside the box instead of in the surrounding layer.
  [[nodiscard]] bool in_box(const std::array<int, 3>& at) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (at[k] < 1 || at[k] > box[k]) return false;
    return true;
  }
  [[nodiscard]] std::size_t count() const { return std::size_t(box[0] + 2) * std::size_t(box[1] + 2) * row; }
  /// Offset of one step along an axis, in memory.
  [[nodiscard]] std::ptrdiff_t step(const std::array<int, 3>& c) const {
    return (std::ptrdiff_t(c[0]) * (box[1] + 2) + c[1]) * std::ptrdiff_t(row) + c[2];
  }
};

class Obstacles {
 public:
  static constexpr std::int32_t none = -1;
  virtual ~Obstacles() = default;
  [[nodiscard]] virtual std::size_t count() const = 0;
  /// The obstacle that covers each site, `none` for fluid; includes the layer around the box.
  [[nodiscard]] virtual std::vector<std::int32_t> owners(const Sites& sites) const = 0;
  /// Distance from a fluid site to an obstacle's surface, over the distance to the covered site; 0 to 1.
  [[nodiscard]] virtual double fraction(std::int32_t owner, const Point& fluid,
                                        const std::array<int, 3>& way) const = 0;
};

struct Sphere {
  Point centre{};     ///< in cells, anywhere: the box is periodic
  double radius = 0;  ///< in cells
};

/// Spheres in a periodic box; where they overlap a site belongs to the sphere in which it is deepest.
class Spheres : public Obstacles {
 public:
  Spheres(std::vector<Sphere> spheres, const std::array<int, 3>& box) : spheres_(std::move(spheres)), box_(box) {}
  [[nodiscard]] std::size_t count() const override { return spheres_.size(); }
  [[nodiscard]] std::vector<std::int32_t> owners(const Sites& sites) const override;
  [[nodiscard]] double fraction(std::int32_t owner, const Point& fluid, const std::array<int, 3>& way) const override;

 private:
  std::vector<Sphere> spheres_;
  std::array<int, 3> box_;
};

}  // namespace polybed::multiscale::lattice
