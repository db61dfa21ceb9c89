#include "relevance/effects/added_mass.hpp"

#include <map>
#include <string>

#include "closures/added_mass.hpp"
#include "dem/effects/maker.hpp"

namespace polybed::dem::makers {

namespace {

double half(double) { return closures::added_mass_of_one; }
double zuber(double solids_fraction) { return closures::added_mass_zuber(solids_fraction); }

const std::map<std::string, double (*)(double)> coefficients{{"half", half}, {"zuber", zuber}};

}  // namespace

extern const Maker added_mass;
const Maker added_mass{&relevance::effects::added_mass, "Inertia",
                       MakeLoad([](const core::Scene&, const std::string& law, LoadLaws& laws) {
                         laws.added_mass = coefficients.at(law);
                       })};

}  // namespace polybed::dem::makers
