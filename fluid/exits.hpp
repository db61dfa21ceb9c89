// The ways out of a column one by one, where there are several: each discharge, and an open top.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "fluid/openings.hpp"

namespace polybed::fluid {

/// "discharge1", "discharge2", ..., "top"; empty if there are fewer than two.
[[nodiscard]] std::vector<std::string> names_of_exits(const core::Scene& scene);

class Exits {
 public:
  Exits() = default;
  /// Collective, as are its functions.
  Exits(const core::Grid& grid, const core::Scene& scene);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Volume flow of fluid and solids out through each, m3/s. \param flux  J, m/s, at time t
  [[nodiscard]] std::vector<double> flows(double t, const core::FaceField& flux) const;
  /// Volume of each species that has left through each since the start, m3, [exit][species].
  [[nodiscard]] std::vector<std::vector<double>> passed(const Openings& openings, const Interphase& solids) const;

 private:
  struct Exit {
    core::ColumnFace at;
    Ramp given;  ///< superficial velocity outwards; empty: the flow follows from the pressure
    double area = 0;
    std::vector<core::Index> face;
    std::vector<double> open;  ///< area of each face in this exit, m2
    std::vector<double> part;  ///< of what leaves through the face
  };
  void add(core::ColumnFace at, Ramp given, const std::vector<double>& share);

  core::Grid grid_;
  std::vector<std::string> names_;
  std::vector<Exit> exits_;
};

}  // namespace polybed::fluid
