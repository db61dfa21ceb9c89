#include "measures/table.hpp"

namespace polybed::measures {

std::vector<Kind> kinds_of(const std::vector<std::string>& species) {
  std::vector<Kind> kinds, whole;
  for (std::size_t j = 0; j < species.size(); ++j) {
    kinds.push_back({species[j], {j}});
    const std::string name = species[j].substr(0, species[j].rfind('.'));
    const bool begins = species[j] == name + ".1",
               goes_on = !whole.empty() && whole.back().name == name &&
                         species[j] == name + "." + std::to_string(whole.back().members.size() + 1);
    if (begins) whole.push_back({name, {}});
    if (!begins && !goes_on) continue;
    whole.back().members.push_back(j);
    kinds.back().is_class = true;
  }
  kinds.insert(kinds.end(), whole.begin(), whole.end());
  return kinds;
}

}  // namespace polybed::measures
