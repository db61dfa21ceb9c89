#include "closures/drag.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include "core/vectors.hpp"

namespace polybed::closures {

namespace {

/// Evaluates a law over rows. A law with a cheap guard is called directly, richardson_zaki without its test for the
/// guard; cello and brinkman_oseen run branch-free over all rows, and a second pass recomputes the rows outside their
/// data.
template <class Law>
void evaluate(const Law& law, std::size_t rows, const double* voidage, const double* reynolds, double* f,
              double* re_dfdre, GuardCount& count) {
  const auto put = [&](std::size_t n, const DragValue& value) {
    f[n] = value.f;
    re_dfdre[n] = value.re_dfdre;
  };
  std::size_t outside = 0;
  if constexpr (requires { law.surely_inside(1.0, 1.0); }) {
    std::size_t inside = 0;
    for (std::size_t n = 0; n < rows; ++n) put(n, law.bare(voidage[n], reynolds[n]));
    for (std::size_t n = 0; n < rows; ++n) inside += law.surely_inside(voidage[n], reynolds[n]) ? 1 : 0;
    for (std::size_t n = 0; n < rows && inside < rows; ++n) {
      if (law.surely_inside(voidage[n], reynolds[n]) || !law.outside(voidage[n], reynolds[n])) continue;
      ++outside;
      put(n, law(voidage[n], reynolds[n]));
    }
  } else {
    for (std::size_t n = 0; n < rows; ++n) outside += law.outside(voidage[n], reynolds[n]) ? 1 : 0;
    if constexpr (requires { law.bare_of_size(1.0, 1.0); }) {
      for (std::size_t n = 0; n < rows; ++n) put(n, law.bare_of_size(voidage[n], reynolds[n]));
      for (std::size_t n = 0; n < rows && outside > 0; ++n)
        if (law.outside(voidage[n], reynolds[n])) put(n, law(voidage[n], reynolds[n]));
    } else {
      bool done = false;
      if constexpr (requires { law.guarded(1.0, 1.0); }) {
        done = law.guard == Guard::on;
        for (std::size_t n = 0; n < rows && done; ++n) put(n, law.guarded(voidage[n], reynolds[n]));
      }
      for (std::size_t n = 0; n < rows && !done; ++n) put(n, law(voidage[n], reynolds[n]));
    }
  }
  count.evaluations += rows;
  count.guarded += outside;
}

/// Cells computed together: few enough that their rows stay in the first-level cache.
struct Block {
  static constexpr std::size_t most = 128;
  using Row = std::array<double, most>;
  std::size_t cells;
  Row cell_voidage, mean, per_mean, coefficient;       // of each cell
  Row voidage, reynolds, offset, factor, f, re_dfdre;  // for one species in each cell
};

/// The block's cells from `begin` on, as input to the law.
template <class Law>
void compose(const Law& law, Block& block, std::size_t begin, std::span<const double> voidage,
             std::span<const double* const> share, std::span<const double> diameter) {
  Block::Row average;
  double largest = 0;
  std::fill_n(average.begin(), block.cells, 0);
  std::fill_n(block.per_mean.begin(), block.cells, 0);
  for (std::size_t j = 0; j < diameter.size(); ++j) {
    const double size = diameter[j], per_size = 1 / size, *x = share[j] + begin;
    largest = std::max(largest, size);
    for (std::size_t c = 0; c < block.cells; ++c) {
      block.per_mean[c] += x[c] * per_size;
      average[c] += x[c] * size;
    }
  }
  for (std::size_t c = 0; c < block.cells; ++c) {
    const MixtureCell cell = mixture_cell(law, voidage[begin + c], {block.per_mean[c], average[c], largest});
    block.cell_voidage[c] = cell.voidage;
    block.mean[c] = cell.mean;
    block.coefficient[c] = cell.coefficient;
  }
}

/// f of one species in all cells in a block.
template <class Law>
void evaluate_species(const Law& law, Block& b, const double* share, const double* slip, double diameter,
                      double per_viscosity, double* f, GuardCount& count) {
  for (std::size_t c = 0; c < b.cells; ++c) {
    const MixtureTerms term =
        law.term({b.cell_voidage[c], b.mean[c], b.per_mean[c], b.coefficient[c]}, diameter, share[c]);
    b.voidage[c] = term.voidage;
    b.reynolds[c] = per_viscosity * slip[c] * term.length;
    b.offset[c] = term.offset;
    b.factor[c] = term.factor;
  }
  evaluate(law.base, b.cells, b.voidage.data(), b.reynolds.data(), b.f.data(), b.re_dfdre.data(), count);
  for (std::size_t c = 0; c < b.cells; ++c) f[c] = b.offset[c] + b.factor[c] * b.f[c];
}

/// Input of each particle in a block.
struct ParticleRows {
  const double *voidage, *per_mean, *average, *per_square, *share, *diameter, *slip;
};

/// f of the particles in a block; each is one species in its own mixture.
template <class Law>
void evaluate_particles(const Law& law, Block& b, const ParticleRows& in, double largest, double per_viscosity,
                        double* f, GuardCount& count) {
  for (std::size_t p = 0; p < b.cells; ++p) {  // separate from the next loop: a longer loop would not be vectorised
    b.per_mean[p] = in.per_mean[p];
    b.coefficient[p] = law.coefficient(in.voidage[p], {in.per_mean[p], in.average[p], largest});
  }
  for (std::size_t p = 0; p < b.cells; ++p) {
    const MixtureCell around{in.voidage[p], 1 / b.per_mean[p], b.per_mean[p], b.coefficient[p]};
    const MixtureTerms term = law.term(around, in.diameter[p], in.share[p]);
    b.voidage[p] = term.voidage;
    b.reynolds[p] = per_viscosity * in.slip[p] * term.length;
    b.offset[p] = term.offset;
    b.factor[p] = term.factor;
  }
  evaluate(law.base, b.cells, b.voidage.data(), b.reynolds.data(), b.f.data(), b.re_dfdre.data(), count);
  for (std::size_t p = 0; p < b.cells; ++p) f[p] = b.offset[p] + b.factor[p] * b.f[p];
}

template <class Law>
struct BlockOf {
  using Type = Block;
};
template <HasMedium Law>
struct BlockOf<Law> {
  struct Type {
    std::size_t cells;
    Block::Row voidage, per_mean, y, reynolds;
    std::array<Block::Row, std::tuple_size_v<typename Law::Medium>> medium;

    [[nodiscard]] typename Law::Medium medium_of(std::size_t cell) const {
      typename Law::Medium m;
      for (std::size_t n = 0; n < m.size(); ++n) m[n] = medium[n][cell];
      return m;
    }
    void set_medium(const Law& law, std::size_t cell, double per_square) {
      const auto m = law.medium(voidage[cell], {per_mean[cell], 0, 0, per_square});
      for (std::size_t n = 0; n < m.size(); ++n) medium[n][cell] = m[n];
    }
  };
};
template <class Law>
using BlockFor = typename BlockOf<Law>::Type;

template <HasMedium Law>
void compose_medium(const Law& law, BlockFor<Law>& block, std::size_t begin, std::span<const double> voidage,
                    std::span<const double* const> share, std::span<const double> diameter) {
  Block::Row per_square;
  std::copy_n(&voidage[begin], block.cells, block.voidage.begin());
  std::fill_n(per_square.begin(), block.cells, 0);
  std::fill_n(block.per_mean.begin(), block.cells, 0);
  for (std::size_t j = 0; j < diameter.size(); ++j) {
    const double per_size = 1 / diameter[j], *x = share[j] + begin;
    for (std::size_t c = 0; c < block.cells; ++c) {
      block.per_mean[c] += x[c] * per_size;
      per_square[c] += x[c] * per_size * per_size;
    }
  }
  for (std::size_t c = 0; c < block.cells; ++c) block.set_medium(law, c, per_square[c]);
}

/// f for y and Re in the media of a block: branch-free over all, then again for those that need the guard.
template <HasMedium Law>
void evaluate_in_media(const Law& law, const BlockFor<Law>& b, double* f, GuardCount& count) {
  for (std::size_t c = 0; c < b.cells; ++c) f[c] = law.base.bare(b.medium_of(c), b.y[c], b.reynolds[c]).f;
  std::size_t outside = 0;
  for (std::size_t c = 0; c < b.cells; ++c) outside += law.base.outside(b.voidage[c], b.reynolds[c]) ? 1 : 0;
  for (std::size_t c = 0; c < b.cells && outside > 0; ++c)
    if (law.base.outside(b.voidage[c], b.reynolds[c]))
      f[c] = law.base.of_species(b.medium_of(c), b.y[c], b.reynolds[c]).f;
  count.evaluations += b.cells;
  count.guarded += outside;
}

template <HasMedium Law>
void evaluate_species_in_media(const Law& law, BlockFor<Law>& b, const double*, const double* slip, double diameter,
                               double per_viscosity, double* f, GuardCount& count) {
  for (std::size_t c = 0; c < b.cells; ++c) {
    b.y[c] = diameter * b.per_mean[c];
    b.reynolds[c] = per_viscosity * slip[c] * diameter;
  }
  evaluate_in_media(law, b, f, count);
}

template <HasMedium Law>
void evaluate_particles_in_media(const Law& law, BlockFor<Law>& b, const ParticleRows& in, double, double per_viscosity,
                                 double* f, GuardCount& count) {
  std::copy_n(in.voidage, b.cells, b.voidage.begin());
  std::copy_n(in.per_mean, b.cells, b.per_mean.begin());
  for (std::size_t p = 0; p < b.cells; ++p) b.set_medium(law, p, in.per_square[p]);
  for (std::size_t p = 0; p < b.cells; ++p) {
    b.y[p] = in.diameter[p] * in.per_mean[p];
    b.reynolds[p] = per_viscosity * in.slip[p] * in.diameter[p];
  }
  evaluate_in_media(law, b, f, count);
}

/// The kernels for a law, with or without a medium.
template <class Law>
struct Kernels {
  static constexpr auto compose = closures::compose<Law>;
  static constexpr auto species = evaluate_species<Law>;
  static constexpr auto particles = evaluate_particles<Law>;
};
template <HasMedium Law>
struct Kernels<Law> {
  static constexpr auto compose = compose_medium<Law>;
  static constexpr auto species = evaluate_species_in_media<Law>;
  static constexpr auto particles = evaluate_particles_in_media<Law>;
};

/// Counts evaluations of a law by the rows it was fitted to, if these are known, otherwise by the range of its form.
class Counting {
 public:
  Counting(const DragLaw& law, GuardCount& count) : rows_(law.fitted_to), count_(count) {}

  /// The count for evaluations of the form.
  [[nodiscard]] GuardCount& of_form() { return rows_ ? unused_ : count_; }

  /// Adds evaluations at voidages and Re = per_viscosity slip/per_length.
  void add(std::span<const double> voidage, const double* slip, double per_viscosity, const double* per_length) {
    if (!rows_) return;
    count_.evaluations += voidage.size();
    for (std::size_t n = 0; n < voidage.size(); ++n) {
      const double reynolds = per_viscosity * slip[n] / (per_length == nullptr ? 1 : per_length[n]);
      count_.guarded += rows_->contains(voidage[n], reynolds) ? 0 : 1;
    }
  }

 private:
  const std::optional<FittedRange>& rows_;
  GuardCount& count_;
  GuardCount unused_;
};

/// Scales f by the factors of a modified law: see DragLaw. \param y  in each row
void move(const DragLaw& law, std::span<const double> y, double* f) {
  for (std::size_t n = 0; n < y.size(); ++n) f[n] *= law.moved(y[n]);
}

/// Scales f of particles of one shape. \param slip  superficial  \param per_length  rho_f D/mu
void shape(const ShapeFactor& factor, std::span<const double> voidage, const double* slip, double per_length,
           double* f) {
  for (std::size_t c = 0; c < voidage.size(); ++c) f[c] *= factor(voidage[c], per_length * slip[c]);
}

/// The law, or the partition that shares its base law.
template <class Body>
void visit_sharing(const DragLaw& law, Body&& body) {
  law.partition ? std::visit(body, *law.partition) : std::visit(body, law.law);
}

/// Converts f of a partition to the mean law: times f_mean/f_one at each cell's mean Reynolds number.
template <class Own>
void take_mean(const DragLaw& law, const Own& own, std::span<const double> voidage, const Block::Row& reynolds,
               double* f, GuardCount& count) {
  const std::size_t cells = voidage.size();
  Block::Row mean, one, slope;
  GuardCount not_told;  // not reported: the range of the mean law counts
  drag_of_points({law.law}, voidage, {reynolds.data(), cells}, {mean.data(), cells}, {slope.data(), cells}, count);
  core::in_vectors<evaluate<Own>>(own, cells, voidage.data(), reynolds.data(), one.data(), slope.data(), not_told);
  for (std::size_t c = 0; c < cells; ++c) f[c] *= mean[c] / one[c];
}

}  // namespace

void drag_of_points(const DragLaw& law, std::span<const double> voidage, std::span<const double> reynolds,
                    std::span<double> f, std::span<double> re_dfdre, GuardCount& count) {
  Counting counting(law, count);
  std::visit(
      [&](const auto& l) {
        core::in_vectors<evaluate<decltype(l.base)>>(l.base, voidage.size(), voidage.data(), reynolds.data(), f.data(),
                                                     re_dfdre.data(), counting.of_form());
      },
      law.law);
  counting.add(voidage, reynolds.data(), 1, nullptr);
  for (std::size_t n = 0; n < f.size() && law.is_moved(); ++n) {
    f[n] *= law.common;
    re_dfdre[n] *= law.common;
  }
  for (std::size_t n = 0; n < f.size() && law.shape; ++n) {
    const DragValue shaped = law.shape->mean({f[n], re_dfdre[n]}, voidage[n], reynolds[n]);
    f[n] = shaped.f;
    re_dfdre[n] = shaped.re_dfdre;
  }
}

void drag_of_cells(const DragLaw& law, std::span<const double> voidage, std::span<const double* const> share,
                   std::span<const double* const> slip, std::span<const double> diameter, double fluid_density,
                   double viscosity, std::span<double* const> f, GuardCount& count) {
  const double per_viscosity = fluid_density / viscosity;
  Counting counting(law, count);
  visit_sharing(law, [&](const auto& l) {
    using Law = std::remove_cvref_t<decltype(l)>;
    BlockFor<Law> block;
    Block::Row reynolds, y;
    GuardCount of_partition;
    for (std::size_t begin = 0; begin < voidage.size(); begin += Block::most) {
      block.cells = std::min(voidage.size() - begin, Block::most);
      core::in_vectors<Kernels<Law>::compose>(l, block, begin, voidage, share, diameter);
      for (std::size_t j = 0; j < diameter.size(); ++j) {
        core::in_vectors<Kernels<Law>::species>(l, block, share[j] + begin, slip[j] + begin, diameter[j], per_viscosity,
                                                f[j] + begin, law.partition ? of_partition : counting.of_form());
        counting.add(voidage.subspan(begin, block.cells), slip[j] + begin, per_viscosity, block.per_mean.data());
        if (law.partition) {
          for (std::size_t c = 0; c < block.cells; ++c)
            reynolds[c] = per_viscosity * slip[j][begin + c] / block.per_mean[c];
          take_mean(law, l.base, voidage.subspan(begin, block.cells), reynolds, f[j] + begin, counting.of_form());
        }
        if (law.shape)
          shape(law.shape->species[j], voidage.subspan(begin, block.cells), slip[j] + begin,
                per_viscosity * diameter[j], f[j] + begin);
        if (!law.is_moved()) continue;
        for (std::size_t c = 0; c < block.cells; ++c) y[c] = diameter[j] * block.per_mean[c];
        move(law, {y.data(), block.cells}, f[j] + begin);
      }
    }
  });
}

bool needs_per_square(const DragLaw& law) {
  bool needs = false;
  visit_sharing(law, [&](const auto& l) { needs = HasMedium<std::remove_cvref_t<decltype(l)>>; });
  return needs;
}

void drag_of_particles(const DragLaw& law, std::span<const double> voidage, std::span<const double> per_mean,
                       std::span<const double> average, std::span<const double> per_square, double largest,
                       std::span<const double> share, std::span<const double> diameter, std::span<const double> slip,
                       double fluid_density, double viscosity, std::span<double> f, GuardCount& count) {
  const double per_viscosity = fluid_density / viscosity;
  Counting counting(law, count);
  visit_sharing(law, [&](const auto& l) {
    using Law = std::remove_cvref_t<decltype(l)>;
    BlockFor<Law> block;
    Block::Row reynolds, y;
    GuardCount of_partition;
    for (std::size_t begin = 0; begin < voidage.size(); begin += Block::most) {
      block.cells = std::min(voidage.size() - begin, Block::most);
      const double* square = per_square.empty() ? nullptr : &per_square[begin];
      const ParticleRows in{&voidage[begin], &per_mean[begin], &average[begin], square,
                            &share[begin],   &diameter[begin], &slip[begin]};
      core::in_vectors<Kernels<Law>::particles>(l, block, in, largest, per_viscosity, &f[begin],
                                                law.partition ? of_partition : counting.of_form());
      counting.add(voidage.subspan(begin, block.cells), in.slip, per_viscosity, in.per_mean);
      if (law.partition) {
        for (std::size_t c = 0; c < block.cells; ++c) reynolds[c] = per_viscosity * in.slip[c] / in.per_mean[c];
        take_mean(law, l.base, voidage.subspan(begin, block.cells), reynolds, &f[begin], counting.of_form());
      }
      if (!law.is_moved()) continue;
      for (std::size_t c = 0; c < block.cells; ++c) y[c] = in.diameter[c] * in.per_mean[c];
      move(law, {y.data(), block.cells}, &f[begin]);
    }
  });
}

}  // namespace polybed::closures
