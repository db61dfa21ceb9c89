#include "closures/drag.hpp"

#include <stdexcept>
#include <type_traits>
#include <utility>

namespace polybed::closures {

namespace {

template <class Body, std::size_t... Places>
void for_each_law(Body&& body, std::index_sequence<Places...>) {
  (body(std::type_identity<std::variant_alternative_t<Places, DragLaw>>{}), ...);
}

template <class Body>
void for_each_law(Body&& body) {
  for_each_law(body, std::make_index_sequence<std::variant_size_v<DragLaw>>{});
}

/// The bare law of the thesis over rows. Compiled for wider vectors as well, the widest that the processor has being
/// chosen when the program starts; without fused multiply-adds (-ffp-contract=off) all give the same bits.
#if defined(__x86_64__) && defined(__gnu_linux__)
__attribute__((target_clones("avx512f", "avx2", "default")))
#endif
void cello_rows(std::size_t rows, const double* voidage, const double* reynolds, double* f, double* re_dfdre) {
  for (std::size_t n = 0; n < rows; ++n) {
    const DragValue value = DragCello::bare(voidage[n], reynolds[n]);
    f[n] = value.f;
    re_dfdre[n] = value.re_dfdre;
  }
}

/// Law over rows. A law without costly guard is called as it is; cello runs branch-free over all rows and a
/// second pass redoes those outside its data.
template <class Law>
void evaluate(const Law& law, std::size_t rows, const double* voidage, const double* reynolds, double* f,
              double* re_dfdre, GuardCount& count) {
  std::size_t outside = 0;
  if constexpr (std::is_same_v<Law, DragCello>) {
    cello_rows(rows, voidage, reynolds, f, re_dfdre);
    for (std::size_t n = 0; n < rows; ++n) {
      // Re_c is at least 687 within the data, so most rows need no square root.
      constexpr double always_inside = 600;
      if (voidage[n] >= DragCello::least_voidage && voidage[n] <= 1 && reynolds[n] <= always_inside) continue;
      if (!law.outside(voidage[n], reynolds[n])) continue;
      ++outside;
      const DragValue value = law(voidage[n], reynolds[n]);
      f[n] = value.f;
      re_dfdre[n] = value.re_dfdre;
    }
  } else {
    for (std::size_t n = 0; n < rows; ++n) {
      const DragValue value = law(voidage[n], reynolds[n]);
      f[n] = value.f;
      re_dfdre[n] = value.re_dfdre;
    }
    for (std::size_t n = 0; n < rows; ++n) outside += law.outside(voidage[n], reynolds[n]) ? 1 : 0;
  }
  count.evaluations += rows;
  count.guarded += outside;
}

}  // namespace

DragLaw drag_law(std::string_view name, Guard guard) {
  DragLaw law;
  bool found = false;
  for_each_law([&](auto type) {
    using Law = typename decltype(type)::type;
    if (Law::name != name) return;
    Law chosen;
    chosen.base.guard = guard;
    law = chosen;
    found = true;
  });
  if (!found) throw std::invalid_argument("unknown drag law '" + std::string(name) + "'");
  return law;
}

std::vector<DragLawInfo> drag_laws() {
  std::vector<DragLawInfo> list;
  for_each_law([&](auto type) {
    using Law = typename decltype(type)::type;
    list.push_back({std::string(Law::name), std::string(Law::help), Law::obeys_sum_rule});
  });
  return list;
}

std::vector<std::string> drag_law_names() {
  std::vector<std::string> names;
  for (const DragLawInfo& law : drag_laws()) names.push_back(law.name);
  return names;
}

void drag_of_points(const DragLaw& law, std::span<const double> voidage, std::span<const double> reynolds,
                    std::span<double> f, std::span<double> re_dfdre, GuardCount& count) {
  std::visit(
      [&](const auto& l) {
        evaluate(l.base, voidage.size(), voidage.data(), reynolds.data(), f.data(), re_dfdre.data(), count);
      },
      law);
}

void drag_of_mixture(const DragLaw& law, double voidage, std::span<const double> share,
                     std::span<const double> diameter, std::span<const double> slip, double fluid_density,
                     double viscosity, std::span<double> f, std::span<double> re_dfdre) {
  std::vector<MixtureTerms> terms(diameter.size());
  std::visit(
      [&](const auto& l) {
        l.terms(voidage, share, diameter, terms);
        for (std::size_t j = 0; j < diameter.size(); ++j) {
          const DragValue base = l.base(terms[j].voidage, fluid_density * slip[j] * terms[j].length / viscosity);
          f[j] = terms[j].offset + terms[j].factor * base.f;
          re_dfdre[j] = terms[j].factor * base.re_dfdre;
        }
      },
      law);
}

double drag_of_mean(const DragLaw& law, double voidage, double reynolds, std::span<const double> share,
                    std::span<const double> diameter, std::span<const double> f) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (std::remove_cvref_t<decltype(l)>::mean_is_base) {
          return l.base(voidage, reynolds).f;
        } else {
          const double mean = sauter_diameter(share, diameter);
          double sum = 0;
          for (std::size_t j = 0; j < f.size(); ++j)
            sum += share[j] * f[j] * (mean / diameter[j]) * (mean / diameter[j]);
          return sum;
        }
      },
      law);
}

void DragWorkspace::resize(std::size_t cells, std::size_t species) {
  for (auto* v : {&voidage, &reynolds, &offset, &factor, &f, &re_dfdre}) v->resize(cells * species);
  share.resize(species);
  diameter.resize(species);
  terms.resize(species);
}

void drag_of_cells(const DragLaw& law, std::span<const double> voidage, std::span<const double* const> share,
                   std::span<const double* const> slip, std::span<const double> diameter, double fluid_density,
                   double viscosity, std::span<double* const> f, DragWorkspace& work, GuardCount& count) {
  const std::size_t cells = voidage.size(), species = diameter.size();
  const double per_viscosity = fluid_density / viscosity;
  std::visit(
      [&](const auto& l) {
        for (std::size_t c = 0; c < cells; ++c) {
          for (std::size_t j = 0; j < species; ++j) work.share[j] = share[j][c];
          l.terms(voidage[c], work.share, diameter, work.terms);
          for (std::size_t j = 0; j < species; ++j) {
            const std::size_t row = j * cells + c;
            work.voidage[row] = work.terms[j].voidage;
            work.reynolds[row] = per_viscosity * slip[j][c] * work.terms[j].length;
            work.offset[row] = work.terms[j].offset;
            work.factor[row] = work.terms[j].factor;
          }
        }
        evaluate(l.base, cells * species, work.voidage.data(), work.reynolds.data(), work.f.data(),
                 work.re_dfdre.data(), count);
      },
      law);
  for (std::size_t j = 0; j < species; ++j)
    for (std::size_t c = 0; c < cells; ++c) {
      const std::size_t row = j * cells + c;
      f[j][c] = work.offset[row] + work.factor[row] * work.f[row];
    }
}

}  // namespace polybed::closures
