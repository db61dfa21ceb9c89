#include "tfm/parts/first_order.hpp"

#include "core/numerics/ranks.hpp"
#include "core/output/checkpoint.hpp"

namespace polybed::tfm {

void FirstOrder::use() {
  equations_.take_first_order_on(fallback_.steps_left().empty() ? nullptr : &fallback_.faces());
}

void FirstOrder::end_step(std::span<const double> y) {
  fallback_.see(layout_, y, equations_.effects().solids_stress.get());
  use();
}

void FirstOrder::begin_from_other(double, std::span<const double>) {
  fallback_.restore(layout_, {}, 0);
  use();
}

void FirstOrder::write(core::Checkpoint& checkpoint, double) const {
  if (!fallback_.steps_left().empty()) checkpoint.arrays["first_order_steps_left"] = fallback_.steps_left();
}

/// A run has flags only while a cell is out of bounds, so a checkpoint without them has none.
void FirstOrder::read(const core::Checkpoint& checkpoint, double) {
  const auto flags = checkpoint.arrays.find("first_order_steps_left");
  const bool known = checkpoint.integers.contains("first_order_cells");
  double count = known ? double(checkpoint.count("first_order_cells")) : 0.0;
  core::take_from_first(equations_.constants().grid.ranks.get(), std::span(&count, 1));
  fallback_.restore(layout_, flags == checkpoint.arrays.end() ? std::vector<double>() : flags->second,
                    std::uint64_t(count));
  use();
}

}  // namespace polybed::tfm
