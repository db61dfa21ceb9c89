#include "measures/bed_table.hpp"

#include "measures/bed.hpp"

namespace polybed::measures {

namespace {

Measure<Bed>::OfWhole of_profile(Value (*measure)(const Profile&)) {
  return [measure](const Bed& bed) { return measure(bed.profile); };
}

Profile by_name(const Profile& profile, const std::vector<Kind>& species) {
  Profile found{profile.slab, {}, {}, profile.areas};
  for (const Kind& kind : species) found.fraction.push_back(merged(profile, kind.members).fraction[0]);
  return found;
}

Measure<Bed>::OfNamed between_species(Value (*measure)(const Profile&)) {
  return [measure](const Bed& bed, const std::vector<Kind>& species) { return measure(by_name(bed.profile, species)); };
}

Value pressure_drop_of(const Bed& bed) {
  if (bed.pressure_drop || bed.profile.pressure.empty()) return bed.pressure_drop;
  return pressure_drop(bed.profile);
}

/// Of the solids, in units of the slabs' height.
double volume_of(const Profile& profile) {
  double sum = 0;
  for (std::size_t k = 0; k < profile.slabs(); ++k) sum += profile.solids_fraction(k) * profile.area(k);
  return sum;
}

Value centre_of(const Bed& bed, Members species) {
  if (bed.centre.empty()) {
    const Profile one = merged(bed.profile, species);
    return volume_of(one) > trace * volume_of(bed.profile) ? centre(one, 0) : Value();
  }
  if (species.size() == 1) return bed.centre[species[0]];
  double moment = 0, mass = 0;
  for (const std::size_t j : species)
    if (bed.centre[j]) {
      moment += bed.mass[j] * *bed.centre[j];
      mass += bed.mass[j];
    }
  return mass > 0 ? Value(moment / mass) : Value();
}

}  // namespace

namespace {

Table<Bed> whole_bed_table() {
  const Readers all{.profile = true, .drift = true, .picture = true}, and_drift{.profile = true, .drift = true},
      and_picture{.profile = true, .picture = true}, also_profiles{.profile = true},
      only_profiles{.history = false, .profile = true};
  return {
      {"time", "s", "time", [](const Bed& bed) { return bed.time; }},
      {"dt", "s", "length of the step that contains it", [](const Bed& bed) { return bed.step; }},
      {"bed_height", "m",
       "highest z where phi, linear between slab centres, equals half of the volume-weighted mean of phi between "
       "z_0.80 and z_0.95",
       of_profile(bed_height), all},
      {"dense_height", "m",
       "the same for half of the mean of phi below z_0.50: the top of the dense bed, below what is suspended",
       of_profile(dense_height), also_profiles},
      {"bed_height_by_pressure", "m",
       "where two straight lines through p cross, by least squares over z_0.10 to z_0.80 and above 1.1 bed heights; "
       "none in layers whose p the first misses by more than 2 % of the drop",
       of_profile(bed_height_by_pressure), only_profiles},
      {"pressure_drop", "Pa",
       "net pressure at the bottom less that at the top, continued linearly from the outer two slabs, in the history "
       "by the weights in the lowest two; with the weight of a compressible fluid beyond rho_0",
       pressure_drop_of, also_profiles},
      {"buoyant_weight", "Pa",
       "of the bed in the fluid, over the cross-section: the mean pressure drop of a fluidised bed; in a tapered "
       "column of each layer over its own: the drop is some per cent more",
       [](const Bed& bed) { return bed.buoyant_weight; }},
      {"centre", "m", "sum z phi_j / sum phi_j; in the history of particles the mean height of their centres",
       centre_of, and_drift},
      {"mass", "kg", "in the column", [](const Bed& bed, Members species) { return sum_of(bed.mass, species); }},
      {"top", "m", "bed_height by phi_j alone: how far up the species reaches; in layers the interface to the next one",
       [](const Bed& bed, Members species) { return bed_height(merged(bed.profile, species)); }, also_profiles},
      {"centre_difference", "1", "centre of species 2 less that of species 1, over bed_height",
       between_species(centre_difference), only_profiles},
      {"interface", "m",
       "the height at which the parts below it of a species and of all others differ most, as shares of each; the bed "
       "height if they differ by less than 0.05; size classes count as one species",
       between_species(interface_height), and_picture},
      {"mixing", "1",
       "1 - 2 integral |F_i - F_j| dh, mean over pairs of species: F is the part of a species below a height, h that "
       "of both together; 1 mixed, 0 in layers, for any shares; size classes count as one species",
       between_species(mixing), also_profiles},
  };
}

}  // namespace

Table<Bed> bed_table(bool around) {
  Table<Bed> table = whole_bed_table();
  for (Measure<Bed>& measure : table) {
    if (!around || !measure.readers.profile) continue;
    if (measure.of_species())
      measure.of = [](const Bed&, Members) { return Value(); };
    else
      measure.of = [](const Bed&) { return Value(); };
  }
  return table;
}

Table<Beside> distance_table() {
  const Readers only_profiles{.history = false, .profile = true};
  return {
      {"composition", "1",
       "half the sum over the species of the mean of |x_j - x_j,ref| over the slices: 0 alike, 1 nowhere alike",
       [](const Beside& beds, const std::vector<Kind>& species) {
         return composition_distance(by_name(beds.profile, species), by_name(beds.reference, species));
       },
       only_profiles},
      {"profile", "1",
       "integral over z of |phi_j - phi_j,ref| over that of phi_j,ref, mean over species: 0 alike, 2 nowhere together",
       [](const Beside& beds) { return profile_distance(beds.profile, beds.reference); }, only_profiles},
      {"profile", "1", "the same of one species",
       [](const Beside& beds, Members species) {
         return profile_distance(merged(beds.profile, species), merged(beds.reference, species), 0);
       },
       only_profiles},
  };
}

}  // namespace polybed::measures
