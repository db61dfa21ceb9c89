// What the particle model takes from the heap: nothing in a step that does not list the pairs anew, and nothing where
// its exchange with the fluid is smoothed.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "core/case/file.hpp"
#include "dem/model.hpp"
#include "fluid/smoothing.hpp"

namespace {
std::atomic<std::size_t> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  if (void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return counted(size, 16); }
void* operator new[](std::size_t size) { return counted(size, 16); }
void* operator new(std::size_t size, std::align_val_t alignment) { return counted(size, std::size_t(alignment)); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return counted(size, std::size_t(alignment)); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace polybed::dem {
namespace {

TEST(DemAllocations, AStepTakesNothingFromTheHeap) {
  core::Timers timers;
  const core::Scene scene = core::parse_case(
      "[column]\nsize = [0.01, 0.01, 0.01]\ncells = [4, 4, 4]\n[fluid]\nname = \"none\"\n"
      "[[species]]\nname = \"a\"\ndiameter = 0.001\ndensity = 2500\n[bed]\nparticles = [300]\nstart = \"random\"\n"
      "solids_fraction = 0.6\n[effects]\ncontact = \"hertz_mindlin\"\n"
      "[dem]\nstart_speed = 0.3\ngreatest_speed = 2\nyoungs_modulus = 5e7\nintegrator = \"synchronised\"\n[run]\nuntil "
      "= 1\n",
      "case.toml", {}, roles());
  Model model(scene, timers);
  model.step(1);  // the first names the timers
  int steps = 0, lists = 0;
  for (int n = 0; n < 500; ++n) {
    const std::uint64_t made = model.work().rebuilds;
    const std::size_t before = allocations;
    model.step(1);
    const std::size_t taken = allocations - before;
    if (model.work().rebuilds != made) {
      ++lists;
      EXPECT_GT(taken, 0);  // which shows that they are counted
    } else {
      ++steps;
      EXPECT_EQ(taken, 0) << "step " << n;
    }
  }
  EXPECT_GT(lists, 5);
  EXPECT_GT(steps, 300);
}

TEST(DemAllocations, SmoothingTakesNothingFromTheHeap) {
  core::Grid grid;
  grid.cells = {12, 30, 1};
  grid.periodic[0] = true;
  const std::size_t at_first = allocations;
  const fluid::Smoothing smoothing(grid, 4, false);
  core::Field field = core::make_field(grid, 1);
  const std::size_t before = allocations;
  EXPECT_GT(before, at_first);  // which shows that they are counted
  smoothing.smooth_cells(field);
  for (int axis = 0; axis < 2; ++axis) smoothing.smooth_faces(field, axis);
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace polybed::dem
