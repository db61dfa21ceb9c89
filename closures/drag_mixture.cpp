// One cell with a mixture, species by species: f_j, its derivative, and the mean.
#include <type_traits>

#include "closures/drag.hpp"

namespace polybed::closures {

namespace {

/// f_j and Re df_j/dRe of every species from a mixture law.
template <class Law>
void species_of_mixture(const Law& law, double voidage, const Composition& composition, std::span<const double> share,
                        std::span<const double> diameter, std::span<const double> slip, double fluid_density,
                        double viscosity, std::span<double> f, std::span<double> re_dfdre) {
  if constexpr (HasMedium<Law>) {
    const auto medium = law.medium(voidage, composition);
    for (std::size_t j = 0; j < diameter.size(); ++j) {
      const DragValue value = law.base.of_species(medium, diameter[j] * composition.per_mean,
                                                  fluid_density * slip[j] * diameter[j] / viscosity);
      f[j] = value.f;
      re_dfdre[j] = value.re_dfdre;
    }
  } else {
    const MixtureCell cell = mixture_cell(law, voidage, composition);
    for (std::size_t j = 0; j < diameter.size(); ++j) {
      const MixtureTerms term = law.term(cell, diameter[j], share[j]);
      const DragValue base = law.base(term.voidage, fluid_density * slip[j] * term.length / viscosity);
      f[j] = term.offset + term.factor * base.f;
      re_dfdre[j] = term.factor * base.re_dfdre;
    }
  }
}

/// The law of one size, without the factor of a modified law.
DragValue base_at(const DragLaw& law, double voidage, double reynolds) {
  return std::visit([&](const auto& l) { return l.base(voidage, reynolds); }, law.law);
}

double mean_of_species(std::span<const double> share, std::span<const double> diameter, std::span<const double> f) {
  const double mean = sauter_diameter(share, diameter);
  double sum = 0;
  for (std::size_t j = 0; j < f.size(); ++j) sum += share[j] * f[j] * (mean / diameter[j]) * (mean / diameter[j]);
  return sum;
}

}  // namespace

void drag_of_mixture(const DragLaw& law, double voidage, std::span<const double> share,
                     std::span<const double> diameter, std::span<const double> slip, double fluid_density,
                     double viscosity, std::span<double> f, std::span<double> re_dfdre) {
  const Composition composition = composition_of(share, diameter);
  const auto find = [&](const auto& l) {
    species_of_mixture(l, voidage, composition, share, diameter, slip, fluid_density, viscosity, f, re_dfdre);
  };
  if (!law.partition)
    std::visit(find, law.law);
  else
    std::visit(
        [&](const auto& part) {
          find(part);
          for (std::size_t j = 0; j < diameter.size(); ++j) {
            const double reynolds = fluid_density * slip[j] / (composition.per_mean * viscosity);
            const DragValue mean = base_at(law, voidage, reynolds), one = part.base(voidage, reynolds);
            const double ratio = f[j] / one.f, slope = (re_dfdre[j] - ratio * one.re_dfdre) / one.f;
            f[j] = ratio * mean.f;
            re_dfdre[j] = ratio * mean.re_dfdre + slope * mean.f;
          }
        },
        *law.partition);
  for (std::size_t j = 0; j < diameter.size() && law.shape; ++j) {
    const DragValue shaped =
        law.shape->species[j]({f[j], re_dfdre[j]}, voidage, fluid_density * slip[j] * diameter[j] / viscosity);
    f[j] = shaped.f;
    re_dfdre[j] = shaped.re_dfdre;
  }
  for (std::size_t j = 0; j < diameter.size() && law.is_moved(); ++j) {
    const double factor = law.moved(diameter[j] * composition.per_mean);
    f[j] *= factor;
    re_dfdre[j] *= factor;
  }
}

double pure_drag_at(const DragLaw& law, double voidage, double reynolds) {
  double f = 0, slope = 0;
  GuardCount count;
  drag_of_points(law, {&voidage, 1}, {&reynolds, 1}, {&f, 1}, {&slope, 1}, count);
  return f;
}

double drag_of_mean(const DragLaw& law, double voidage, double reynolds, std::span<const double> share,
                    std::span<const double> diameter, std::span<const double> f) {
  const auto built_on_base = [](const auto& l) { return std::remove_cvref_t<decltype(l)>::mean_is_base; };
  const bool base = law.partition ? std::visit(built_on_base, *law.partition) : std::visit(built_on_base, law.law);
  return base ? pure_drag_at(law, voidage, reynolds) : mean_of_species(share, diameter, f);
}

double deviation_from_base(const DragLaw& law, double voidage, double reynolds, std::span<const double> share,
                           std::span<const double> diameter, std::span<const double> f) {
  return mean_of_species(share, diameter, f) / pure_drag_at(law, voidage, reynolds) - 1;
}

}  // namespace polybed::closures
