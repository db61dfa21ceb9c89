// Slot Exchange, fluid with solids: drag on every species from any law in the menu, one closure pass per cell.
#include "relevance/effects/drag.hpp"

#include <algorithm>

#include "closures/drag.hpp"
#include "core/numerics/metric.hpp"
#include "fluid/fluid_state.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/effects/gas_slip.hpp"
#include "relevance/effects/partition.hpp"
#include "relevance/effects/shape.hpp"
#include "tfm/effects.hpp"
#include "tfm/effects/maker.hpp"

namespace polybed::tfm {

namespace {

using core::Index;

/// b_j = 18 mu eps f_j / D_j^2, T(1.49), with f_j from the polydisperse law at the cell's voidage, composition and the
/// superficial slip of species j. Form B uses the net force instead, with the pressure gradient of a uniform bed: b_j +
/// sum_k phi_k b_k/eps, for one species b/eps.
class Drag : public FluidExchange {
 public:
  /// \param divisors  of the drag on each species through gas slip; 1 without slip
  Drag(const Constants& constants, const fluid::Boundaries& boundaries, const std::string& name,
       const closures::DragLaw& law, std::vector<double> divisors)
      : constants_(constants), boundaries_(boundaries), name_(name), law_(law), divisors_(std::move(divisors)) {
    share_.resize(constants.species());
    slip_.resize(constants.species());
    result_.resize(constants.species());
  }
  void evaluate(Fields& fields) override {
    const double scale = 18 * constants_.fluid.viscosity;
    core::for_each_open_row(constants_.grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
      const std::size_t row = std::size_t(begin), cells = std::size_t(end - begin);
      for (std::size_t j = 0; j < constants_.species(); ++j) {
        share_[j] = fields.share[j].data() + row;
        slip_[j] = fields.slip_superficial[j].data() + row;
        result_[j] = fields.solids.exchange[j].data() + row;
      }
      const std::span<const double> eps(fields.fluid.voidage.data() + row, cells);
      closures::drag_of_cells(law_, eps, share_, slip_, constants_.diameter, constants_.fluid.density,
                              constants_.fluid.viscosity, result_, count_);
      for (std::size_t j = 0; j < constants_.species(); ++j) {
        const double factor = scale / (constants_.diameter[j] * constants_.diameter[j] * divisors_[j]);
        for (std::size_t c = 0; c < cells; ++c) result_[j][c] *= factor * eps[c];
      }
      if (constants_.form_b) add_pressure_gradient(fields, row, cells);
    });
    boundaries_.fill_cells(fields.solids.exchange);
  }

  [[nodiscard]] ClosureUse use() const override { return {"drag " + name_, count_.evaluations, count_.guarded}; }

 private:
  void add_pressure_gradient(const Fields& fields, std::size_t row, std::size_t cells) const {
    for (std::size_t c = 0; c < cells; ++c) {
      double sum = 0;
      for (std::size_t k = 0; k < constants_.species(); ++k) sum += fields.solids.fraction[k][row + c] * result_[k][c];
      sum /= std::max(fields.fluid.voidage[row + c], fluid::voidage_floor);
      for (std::size_t j = 0; j < constants_.species(); ++j) result_[j][c] += sum;
    }
  }

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  std::string name_;
  closures::DragLaw law_;
  closures::GuardCount count_;
  std::vector<double> divisors_;
  std::vector<const double*> share_, slip_;
  std::vector<double*> result_;
};

}  // namespace

namespace makers {

extern const Maker drag, partition, shape, gas_slip;
const Maker drag{&relevance::effects::drag, "Exchange", [](const Making& m) {
                   m.effects.drag = std::make_unique<Drag>(m.constants, m.boundaries, relevance::drag_name_of(m.scene),
                                                           relevance::drag_law_of(m.scene),
                                                           relevance::slip_divisors(m.scene, m.constants.diameter));
                 }};
const Maker partition{&relevance::effects::partition, "Exchange"};
const Maker shape{&relevance::effects::shape, "Exchange"};
const Maker gas_slip{&relevance::effects::gas_slip, "Exchange"};

}  // namespace makers

}  // namespace polybed::tfm
