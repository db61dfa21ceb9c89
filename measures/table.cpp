#include "measures/table.hpp"

namespace polybed::measures {

std::vector<Kind> kinds_of(const std::vector<std::string>& species) {
  std::vector<Kind> kinds;
  for (std::size_t j = 0; j < species.size(); ++j) kinds.push_back({species[j], {j}});
  const auto place = [&](const std::string& name) {
    return std::size_t(std::find(species.begin(), species.end(), name) - species.begin());
  };
  for (const std::string& first : species) {
    Kind whole{first.substr(0, first.rfind('.')), {}};
    if (first != whole.name + ".1" || place(whole.name) < species.size()) continue;
    for (std::size_t j = place(first); j < species.size();
         j = place(whole.name + "." + std::to_string(whole.members.size() + 1)))
      whole.members.push_back(j);
    if (whole.members.size() < 2) continue;  // a single class is the whole species
    for (const std::size_t j : whole.members) kinds[j].is_class = true;
    kinds.push_back(std::move(whole));
  }
  return kinds;
}

std::vector<Kind> named_species(const std::vector<std::string>& species) {
  std::vector<Kind> kinds = kinds_of(species);
  std::erase_if(kinds, [](const Kind& kind) { return kind.is_class; });
  std::sort(kinds.begin(), kinds.end(), [](const Kind& a, const Kind& b) { return a.members < b.members; });
  return kinds;
}

std::vector<Kind> divided_species(const std::vector<std::string>& species) {
  std::vector<Kind> kinds = named_species(species);
  std::erase_if(kinds, [](const Kind& kind) { return kind.members.size() < 2; });
  return kinds;
}

core::Field sum_of(const std::vector<core::Field>& fractions, Members members) {
  core::Field sum = fractions[members.front()];
  for (const std::size_t j : members.subspan(1))
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += fractions[j][c];
  return sum;
}

}  // namespace polybed::measures
