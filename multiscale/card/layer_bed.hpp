// A bed in layers that stay apart: each is a bed of its own.
#pragma once

#include <vector>

#include "core/case/scene.hpp"
#include "multiscale/card/balance.hpp"
#include "multiscale/card/bed_of_case.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

/// The mixture with its Sauter diameter and mean density. \param share  of each species; their sum can be below 1
[[nodiscard]] closures::CarriedBed mixture_of(const core::Scene& scene, const std::vector<double>& share,
                                              const relevance::FluidConstants& fluid, double gravity);

/// A layer of a bed as a bed of its own.
struct LayerBed {
  closures::CarriedBed bed;         ///< its species with their Sauter diameter and mean density
  double packed = 0;                ///< voidage of the settled layer
  double solids = 0;                ///< volume over the area of the bottom, m
  std::optional<std::size_t> only;  ///< its species, if it is one

  /// The balance of a bed, as it is in this layer.
  [[nodiscard]] Balance of(Balance balance) const {
    balance.packed = packed;
    if (only && balance.law) balance.law = balance.law->alone(*only);
    return balance;
  }
};

/// The layers of a bed that lie on each other across the whole column; empty for a bed that starts as one,
/// and if a layer is lighter than the fluid.
/// \param share  of each species; those that leave the bed have 0
[[nodiscard]] std::vector<LayerBed> layers_of(const core::Scene& scene, const Slices& slices,
                                              const std::vector<double>& share, const relevance::FluidConstants& fluid,
                                              double gravity);

/// A layer for each species of a mixed bed. \param solids  volume of each over the area of the bottom, m
[[nodiscard]] std::vector<LayerBed> layers_of_species(const core::Scene& scene, const std::vector<double>& solids,
                                                      const relevance::FluidConstants& fluid, double gravity);

/// These layers with the one of the greatest bulk density below; nothing if the bulk densities are within 5 %, or if a
/// layer is lighter than the fluid.
[[nodiscard]] std::optional<PartedBed> parted(const core::Scene& scene, const Balance& balance,
                                              const std::vector<LayerBed>& layers, double velocity);

/// Velocities at which the layers begin to expand by themselves, m/s. \param of_one  that of a bed without layers
[[nodiscard]] std::vector<double> lifting_velocities(const Balance& balance, const std::vector<LayerBed>& layers,
                                                     double of_one);

/// Whether an expanded layer has a greater bulk density than the one below it: they mix, or change places.
[[nodiscard]] bool turns_over(const Balance& balance, const std::vector<LayerBed>& layers, double velocity);

/// Sum over the layers of a property of each; nothing if one has none.
template <class Property>
[[nodiscard]] std::optional<double> sum_over(const std::vector<LayerBed>& layers, const Property& property) {
  double sum = 0;
  for (const LayerBed& layer : layers) {
    const std::optional<double> one = property(layer);
    if (!one) return {};
    sum += *one;
  }
  return sum;
}

}  // namespace polybed::multiscale
