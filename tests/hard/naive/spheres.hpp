// Dry spheres as a textbook moves them, for tests only: all pairs, no guard of any kind.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "hard/textbook.hpp"

namespace polybed::hard::naive {

/// Hertz with Tsuji's dashpot, incremental tangential force with Coulomb's cap, velocity Verlet, with the treatment of
/// a name:
///   fixed_dt      the step that the case gives, whatever stiffness and speed ask for
///   lost_history  tangential forces are forgotten every fifty steps, as if the list of pairs were made anew
///   one_wall      only the wall that is pressed deepest acts
///   one_image     in periodic directions only the nearest image of a pair acts
///   float_sums    forces on a particle are added in single precision
///   nothing       no change
/// Throws std::invalid_argument for any other name.
class Spheres final : public hard::TextbookSpheres {
 public:
  Spheres(const std::string& name, const core::Scene& scene, const std::vector<scenes::Bead>& beads);

  void steps(std::int64_t number) override;
  [[nodiscard]] const dem::Place& place(std::int64_t id) const override { return place_[std::size_t(id)]; }
  [[nodiscard]] const dem::Motion& motion(std::int64_t id) const override { return motion_[std::size_t(id)]; }
  [[nodiscard]] dem::Vector force(std::int64_t id) const override { return force_[std::size_t(id)]; }

 private:
  /// Tangential force on the first body and the stiffness that it was found with.
  struct Memory {
    dem::Vector force{};
    double stiffness = 0;
    bool seen = false;
  };
  struct Touch {
    std::size_t first = 0;
    std::size_t second = 0;  ///< the first one itself: a wall
    dem::Vector normal{};    ///< from the first to the second or the wall
    double overlap = 0;
  };
  void find_forces();
  void add_pair(std::size_t i, std::size_t j, int key, const dem::Vector& shift);
  void add_walls(std::size_t i);
  void act(const Touch& touch, int key);
  void add(std::size_t i, const dem::Vector& force, const dem::Vector& torque);

  std::string name_;
  core::Scene scene_;
  double dt_;
  std::int64_t count_ = 0;
  std::vector<dem::Place> place_;
  std::vector<dem::Motion> motion_;
  std::vector<double> modulus_;  ///< E/(1 - nu^2) of each body
  std::vector<dem::Vector> force_, torque_;
  std::map<std::array<int, 3>, Memory> memory_;  ///< of a body, another or itself, an image or a wall
};

}  // namespace polybed::hard::naive
