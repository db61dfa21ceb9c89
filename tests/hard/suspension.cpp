#include "hard/suspension.hpp"

#include "dem/coupling/coupling.hpp"

namespace polybed::hard {

namespace {

class ProductSuspension final : public TextbookSuspension {
 public:
  ProductSuspension(const core::Scene& scene, const std::vector<scenes::Bead>& beads) : run_(scene, beads) {}
  void step() override { run_.steps(run_.model.coupling()->every()); }
  [[nodiscard]] const dem::Particles& particles() const override { return run_.model.particles(); }
  [[nodiscard]] const core::Field& voidage() const override {
    const std::vector<core::Field>& fraction = run_.model.coupling()->fraction();
    voidage_.assign(fraction[0].size(), 1.0);
    for (const core::Field& phi : fraction)
      for (std::size_t c = 0; c < phi.size(); ++c) voidage_[c] -= phi[c];
    return voidage_;
  }
  [[nodiscard]] const fluid::Flow& flow() const override { return run_.model.coupling()->flow(); }

 private:
  scenes::Beads run_;
  mutable core::Field voidage_;
};

}  // namespace

core::Scene scene_of(double diameter, double density, const scenes::Liquid& fluid, double cell,
                     std::array<int, 3> cells, int every) {
  core::Scene scene =
      scenes::wet_box(diameter, density, fluid, {cell * cells[0], cell * cells[1], cell * cells[2]}, cells);
  scene.dem.fluid_every = every;
  return scene;
}

std::unique_ptr<TextbookSuspension> begin_suspension(const Trial& trial, core::Scene scene,
                                                     const std::vector<scenes::Bead>& beads, double dt) {
  scene.dem.fixed_step = dt;
  if (trial.naive()) return textbook::suspension(trial.treatment().naive, scene, beads);
  return std::make_unique<ProductSuspension>(scene, beads);
}

}  // namespace polybed::hard
