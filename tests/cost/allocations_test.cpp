// What the continuum model takes from the heap: nothing in a right-hand side once it has run, and a stated number of
// bytes per cell. Allocations are counted in operator new of the whole program; hypre's and SUNDIALS' own are not seen.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "scenes/record.hpp"
#include "tfm/explicit_problem.hpp"
#include "tfm/implicit_problem.hpp"

namespace {
std::atomic<std::size_t> allocations{0};

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace polybed {
namespace {

/// All effects on, every loop with work to do.
core::Scene everything(int nx, int ny, bool closed) {
  core::Scene scene = scenes::binary_bed(nx, ny, 1.5e-3 * nx, 1.5e-3 * ny);
  scene.effects["fluid_stress"] = "newtonian";
  scene.tfm.max_packing = core::PackingRule::yu_standish;
  scene.column.closed = closed;
  if (closed) scene.inlet.superficial_velocity = {{0.0, 0.0}};
  scene.jets.clear();
  return scene;
}

/// Allocations of the second and third call of `work`; the first may set things up.
template <class Work>
std::size_t after_first(Work&& work) {
  work();
  const std::size_t before = allocations;
  work();
  work();
  return allocations - before;
}

struct Setting {
  core::Timers timers;
  core::Scene scene;
  tfm::Model model;
  tfm::StateLayout layout;
  tfm::RightHandSide equations;
  std::vector<double> y, dydt, r;

  Setting(bool closed, const std::string& integrator)
      : scene([&] {
          core::Scene s = everything(10, 30, closed);
          s.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
          return s;
        }()),
        model(scene, timers),
        layout(model.constants().grid, 2, integrator == "implicit"),
        equations(scene, model.constants(), model.boundaries(), model.inlet(), {}, timers),
        y(model.checkpoint().arrays.at("state")),
        dydt(y.size()),
        r(y.size()) {}
};

class Allocations : public testing::TestWithParam<bool> {};

TEST_P(Allocations, NoneInTheRightHandSide) {
  Setting s(GetParam(), "explicit");
  bool fine = true;
  EXPECT_EQ(after_first([&] { fine = fine && s.equations.evaluate(0, s.layout, s.y); }), 0U);
  EXPECT_TRUE(fine);
}

TEST_P(Allocations, NoneInTheRatesWithThePressureSolved) {
  Setting s(GetParam(), "explicit");
  tfm::ExplicitProblem problem(s.equations, s.layout, 1e-5, s.timers);
  bool fine = true;
  EXPECT_EQ(after_first([&] { fine = fine && problem.rates(0, s.y, s.dydt) == core::Rate::ok; }), 0U);
  EXPECT_TRUE(fine);
}

TEST_P(Allocations, NoneInTheResidualAndItsPreconditioner) {
  Setting s(GetParam(), "implicit");
  tfm::ImplicitProblem problem(s.equations, s.layout, s.timers);
  bool fine = true;
  EXPECT_EQ(after_first([&] { fine = fine && problem.residual(0, s.y, s.dydt, s.r) == core::Rate::ok; }), 0U);
  EXPECT_EQ(after_first([&] { fine = fine && problem.setup(0, s.y, s.dydt, s.r, 100) == core::Rate::ok; }), 0U);
  EXPECT_EQ(after_first([&] { fine = fine && problem.precondition(0, s.r, s.dydt, 100, 0) == core::Rate::ok; }), 0U);
  EXPECT_TRUE(fine);
}

INSTANTIATE_TEST_SUITE_P(OpenAndClosed, Allocations, testing::Bool());

// The count must see what it claims to see.
TEST(AllocationCount, SeesAVector) {
  EXPECT_EQ(after_first([] { std::vector<double> v(100); }), 2U);
}

/// Bytes in use, of everything that calls malloc.
double bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return double(info.uordblks) + double(info.hblkhd);
}

// Two species in two dimensions, all effects on, after two steps, vectors of SUNDIALS and matrices of hypre included: 8
// bytes per number. Bounds are a tenth above what was found, so that a field too many is noticed.
TEST(Memory, PerCell) {
  for (const auto& [integrator, most] : {std::pair{"explicit", 2170.0}, {"implicit", 7100.0}}) {
    const auto total = [&, name = integrator](int ny) {
      core::Scene scene = everything(40, ny, false);
      scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(name);
      core::Timers timers;
      const double before = bytes_in_use();
      tfm::Model model(scene, timers);
      for (int n = 0; n < 2; ++n) model.step(1);
      EXPECT_FALSE(model.constants().grid.metric) << "a box of even cells needs no arrays of open shares";
      return bytes_in_use() - before;
    };
    total(50);  // what libraries keep for good
    const double per_cell = (total(400) - total(200)) / (40.0 * 200.0);
    scenes::record(fmt::format("bytes per cell, {}", integrator), per_cell);
    fmt::print("{}: {:.0f} bytes per cell\n", integrator, per_cell);
    EXPECT_LT(per_cell, most);
  }
}

}  // namespace
}  // namespace polybed
