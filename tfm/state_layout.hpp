// Order of the unknowns in the integrator's state vector: field by field, p last.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/numerics/field.hpp"
#include "fluid/fluid_state.hpp"
#include "fluid/interphase.hpp"
#include "fluid/openings.hpp"

namespace polybed::tfm {

/// The unknowns: phi_j (cells), U_j and J (all owned faces), theta_j (cells) if it has an equation, volumes of solids
/// through faces of ends and sides, and p (cells) if the integrator includes it.
class StateLayout {
 public:
  /// One field of the state: its kind, species (-1 for the mixture), axis (-1 on cells), and place.
  struct Entry {
    enum class Kind { fraction, velocity, flux, temperature, passed, pressure } kind;
    int species, axis;
    std::size_t begin, size;
    core::Box box;
  };

  StateLayout() = default;
  /// \param passages  species, and ends or sides, with an unknown on their faces for the volume that has passed
  StateLayout(const core::Grid& grid, int species, bool with_pressure, bool with_temperature = false,
              const std::vector<fluid::Openings::Passage>& passages = {});

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  [[nodiscard]] bool with_pressure() const { return with_pressure_; }

  /// Copies the state into the padded fields; ghosts stay unchanged.
  void unpack(std::span<const double> y, fluid::Interphase& solids, fluid::FluidState& fluid) const;
  /// Copies the owned part of the padded fields into a state vector.
  void pack(const fluid::Interphase& solids, const fluid::FluidState& fluid, std::span<double> y) const;
  /// Copies one field of a state vector into a padded field.
  void unpack(const Entry& entry, std::span<const double> y, core::Field& field) const;
  /// Copies one padded field to its place in a state vector.
  void pack(const Entry& entry, const core::Field& field, std::span<double> y) const;

  /// Name of a field of the state: "phi_fine", "u_fine.x", "passed_fine.top".
  [[nodiscard]] static std::string name_of(const Entry& entry, const std::vector<std::string>& species);
  /// Name of the field and the cell or face of an entry of the state, for messages.
  [[nodiscard]] std::string describe(std::size_t index, const std::vector<std::string>& species) const;

 private:
  void add(Entry::Kind kind, int species, int axis, const core::Box& box);

  core::Grid grid_;
  bool with_pressure_ = false;
  std::size_t size_ = 0;
  std::vector<Entry> entries_;
};

/// The padded field for an entry of the state; const if the solids and the fluid are.
template <class Solids, class Fluid>
[[nodiscard]] auto& field_of(const StateLayout::Entry& entry, Solids& solids, Fluid& fluid) {
  using Kind = StateLayout::Entry::Kind;
  switch (entry.kind) {
    case Kind::fraction:
      return solids.fraction[std::size_t(entry.species)];
    case Kind::velocity:
      return solids.velocity[std::size_t(entry.species)][std::size_t(entry.axis)];
    case Kind::flux:
      return fluid.flux[std::size_t(entry.axis)];
    case Kind::temperature:
      return solids.temperature[std::size_t(entry.species)];
    case Kind::passed:
      return solids.passed[std::size_t(entry.species)][std::size_t(entry.axis)];
    case Kind::pressure:
      break;
  }
  return fluid.pressure;
}

}  // namespace polybed::tfm
