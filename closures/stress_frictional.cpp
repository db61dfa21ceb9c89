#include "closures/stress_frictional.hpp"

#include <cmath>

namespace polybed::closures {

double max_packing_for(double solids_fraction, double pressure, double strength, double onset) {
  const double above = solids_fraction - onset;
  return solids_fraction + std::pow(strength * above * above / pressure, 0.2);
}

}  // namespace polybed::closures
