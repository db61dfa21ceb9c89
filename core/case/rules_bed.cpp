// Requirements on species and the bed: names, pairs, amounts, and the start.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>
#include <string_view>

#include "core/case/case_rules.hpp"
#include "core/case/layers.hpp"
#include "core/case/size_classes.hpp"

namespace polybed::core {

namespace {

const std::string wall = "wall";  ///< name of the wall in contact pairs

/// Whether a name is valid in the header of a CSV file, in the path of a dataset and in XML.
bool can_name_files(const std::string& name) {
  return !name.empty() && std::none_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 0x20 || c == 0x7f || std::string_view(",/<>&\"\\").find(char(c)) != std::string_view::npos;
  });
}

Broken names_taken(const Scene& scene) {
  Broken broken;
  std::set<std::string> names{wall, "fluid"};  // reserved by contact pairs and by the dataset u_fluid
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    if (!names.insert(scene.species[j].name).second)
      broken.add({scene.species[j].name}, entry_of(scene, scene.species, j));
  return broken;
}

Broken names_unfit(const Scene& scene) {
  Broken broken;
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    if (!can_name_files(scene.species[j].name)) broken.add({scene.species[j].name}, entry_of(scene, scene.species, j));
  return broken;
}

constexpr double least_class = 1e-8, greatest_class = 1;  // m, as for species.diameter

Broken classes_out_of_range(const Scene& scene) {
  Broken broken;
  for (const SizeClasses& record : scene.size_classes)
    for (std::size_t k = 0; k < record.diameter.size(); ++k)
      if (!(record.diameter[k] >= least_class && record.diameter[k] <= greatest_class))
        broken.add({fmt::format("{}.{}", record.species, k + 1), fmt::format("{:.3g}", record.diameter[k])});
  return broken;
}

std::vector<Rule> species_rules() {
  return {{{"species.diameter", "species.distribution"},
           "{} would have a diameter of {} m: fewer species.classes, or a smaller species.deviation",
           classes_out_of_range,
           true},
          {{"species.name"},
           "[[species]]: {} species, at most 15",
           [](const Scene& scene) {
             return scene.species.size() > 15 ? Broken({std::to_string(scene.species.size())}) : Broken();
           }},
          {{"species.name"}, "species.name = \"{}\" stands twice, or is \"wall\" or \"fluid\"", names_taken},
          {{"species.name"},
           "species.name = \"{}\" names columns and datasets: not empty, without , / < > & \" \\ and line ends",
           names_unfit}};
}

Broken partners_unknown(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.contact_pairs.size(); ++n)
    for (const std::string& name : scene.contact_pairs[n].between)
      if (name != wall &&
          std::none_of(scene.species.begin(), scene.species.end(), [&](const auto& s) { return s.name == name; }))
        broken.add({name}, entry_of(scene, scene.contact_pairs, n));
  return broken;
}

Broken pairs_twice(const Scene& scene) {
  Broken broken;
  std::set<std::pair<std::string, std::string>> seen;
  for (std::size_t n = 0; n < scene.contact_pairs.size(); ++n) {
    const ContactPair& pair = scene.contact_pairs[n];
    if (pair.between.size() != 2) continue;
    const auto [first, second] = std::minmax(pair.between[0], pair.between[1]);
    if (!seen.emplace(first, second).second) broken.add({first, second}, entry_of(scene, scene.contact_pairs, n));
  }
  return broken;
}

/// A rule that each pair of species can break.
Rule rule_of_pairs(const std::string& message, bool (*wrong)(const std::vector<std::string>& between)) {
  return {{"contact_pair.between"}, message, [wrong](const Scene& scene) {
            Broken broken;
            for (std::size_t n = 0; n < scene.contact_pairs.size(); ++n)
              if (wrong(scene.contact_pairs[n].between)) broken.add({}, entry_of(scene, scene.contact_pairs, n));
            return broken;
          }};
}

std::vector<Rule> pair_rules() {
  return {rule_of_pairs("contact_pair.between takes two names", [](const auto& names) { return names.size() != 2; }),
          {{"contact_pair.between", "species.name"}, "contact_pair.between: no species '{}'", partners_unknown},
          rule_of_pairs("contact_pair.between: a wall touches no wall; name a species",
                        [](const auto& names) { return names.size() == 2 && names[0] == wall && names[1] == wall; }),
          {{"contact_pair.between"}, "two [[contact_pair]] of {} and {}: write one", pairs_twice}};
}

bool is_list(const Scene& scene) { return scene.bed.start.kind == StartKind::list; }

bool has_classes(const Scene& scene) {
  return !scene.size_classes.empty() ||
         std::any_of(scene.species.begin(), scene.species.end(), [](const Species& s) { return s.sizes.kind; });
}

/// One number for each species, for the species that give the amount.
template <class Number>
Broken miscounted(const Scene& scene, const std::vector<Number>& numbers, bool acts) {
  if (!acts || is_list(scene) || numbers.size() == scene.species.size()) return {};
  return Broken({std::to_string(numbers.size()), std::to_string(scene.species.size())});
}

std::vector<Rule> amount_rules() {
  return {{{"bed.particles", "species.distribution"},
           "bed.particles counts spheres of one size: with a species.distribution give bed.volume_share and "
           "bed.static_height",
           [](const Scene& scene) { return broken_if(has_classes(scene) && !scene.bed.particles.empty()); },
           true},
          {{"bed.particles", "bed.start", "species.name"},
           "bed.particles has {} numbers, there are {} species",
           [](const Scene& scene) { return miscounted(scene, scene.bed.particles, !scene.bed.particles.empty()); },
           true},
          {{"bed.particles", "bed.start"},
           "bed.particles: no particles at all",
           [](const Scene& scene) {
             const auto& numbers = scene.bed.particles;
             return broken_if(!numbers.empty() && !is_list(scene) &&
                              std::all_of(numbers.begin(), numbers.end(), [](auto n) { return n == 0; }));
           },
           true},
          {{"bed.volume_share", "bed.particles", "bed.start", "species.name"},
           "bed.volume_share has {} numbers, there are {} species",
           [](const Scene& scene) {
             const bool follows = !scene.bed.particles.empty() ||  // follows from these, or from the layers
                                  (!scene.layers.empty() && scene.bed.volume_share.empty());
             return miscounted(scene, scene.bed.volume_share, !follows);
           },
           true},
          {{"bed.volume_share", "bed.particles", "bed.start"},
           "bed.volume_share sums to {}, not to 1",
           [](const Scene& scene) {
             const std::vector<double>& share = scene.bed.volume_share;
             const double sum = std::accumulate(share.begin(), share.end(), 0.0);
             return is_list(scene) || std::abs(sum - 1) <= 1e-9 ? Broken() : Broken({fmt::format("{:.9g}", sum)});
           }}};
}

Broken start_denser_than_settled(const Scene& scene) {
  const Bed& bed = scene.bed;
  if (is_list(scene) || !(bed.start_fraction.value_or(bed.solids_fraction) > bed.solids_fraction)) return {};
  return Broken({fmt::format("{}", *bed.start_fraction), fmt::format("{}", bed.solids_fraction)});
}

Broken bed_above_the_column(const Scene& scene) {
  const Bed& bed = scene.bed;
  if (is_list(scene)) return {};
  const Column& column = scene.column;
  const double height = scene.layers.empty() ? column.filled_height(column.even_height(bed.static_height) *
                                                                    bed.solids_fraction / bed.start_solids_fraction)
                                             : top_of(stacked(start_parts(scene), column));
  if (!(height > scene.column.size[1] * (1 + 1e-12))) return {};
  return Broken({fmt::format("{:.4g}", height), fmt::format("{:.4g}", scene.column.size[1])});
}

Broken list_missing(const Scene& scene) {
  std::error_code error;
  const std::filesystem::path path = scene.bed.start.file;
  if (!is_list(scene) || (std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error)))
    return {};
  return Broken({text_of(scene.bed.start)});
}

std::vector<Rule> start_of_bed_rules() {
  return {{{"bed.start_solids_fraction", "bed.solids_fraction", "bed.start"},
           "bed.start_solids_fraction = {} is denser than the settled bed, {}",
           start_denser_than_settled},
          {{"column.size", "bed.static_height", "bed.solids_fraction", "bed.start_solids_fraction", "bed.start",
            "bed.particles", "bed.volume_share"},
           "the bed at its start is {} m high, the column {} m: enlarge column.size",
           bed_above_the_column},
          {{"bed.layer", "bed.start"},
           "bed.layer cannot act: bed.start is not \"layered\"",
           [](const Scene& scene) {
             return broken_if(!scene.bed.layer.empty() && scene.bed.start.kind != StartKind::layered);
           }},
          {{"bed.layer", "species.name"},
           "bed.layer has {} numbers, there are {} species",
           [](const Scene& scene) { return miscounted(scene, scene.bed.layer, !scene.bed.layer.empty()); }},
          {{"bed.start"},
           "bed.start = \"{}\": no such file in the working directory or beside the case file",
           list_missing}};
}

}  // namespace

std::vector<Rule> bed_rules() {
  std::vector<Rule> rules;
  for (const auto& part : {species_rules(), pair_rules(), amount_rules(), start_of_bed_rules()})
    rules.insert(rules.end(), part.begin(), part.end());
  return rules;
}

}  // namespace polybed::core
