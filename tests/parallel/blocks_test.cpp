// Blocks, ghosts and reductions, on as many ranks as mpirun starts: every answer is known from the cell's place.
#include "core/numerics/blocks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/numerics/halo.hpp"
#include "core/numerics/linear_solver.hpp"
#include "core/numerics/mpi.hpp"
#include "core/numerics/reduction.hpp"

namespace polybed::core {
namespace {

Grid column(int dimensions, std::array<int, 3> cells, bool joined) {
  Grid grid;
  grid.dimensions = dimensions;
  grid.cells = cells;
  grid.spacing = {0.5, 0.25, 1};
  grid.periodic = {joined, false, joined && dimensions == 3};
  return grid;
}

std::vector<Grid> columns() {
  return {column(2, {13, 22, 1}, false), column(2, {16, 9, 1}, true), column(2, {25, 5, 1}, true),
          column(3, {9, 13, 10}, false), column(3, {8, 17, 9}, true)};
}

/// A number for each cell of the column, from its indices there; -1 beyond the column's ends.
double name_of(const Grid& grid, std::array<int, 3> cell) {
  for (std::size_t a = 0; a < 3; ++a) {
    const int n = grid.column_cells(int(a));
    cell[a] += grid.before[a];
    if (grid.periodic[a]) cell[a] = (cell[a] + n) % n;
    if (cell[a] < 0 || cell[a] >= n) return -1;
  }
  return cell[0] + 100.0 * cell[1] + 10000.0 * cell[2];
}

template <class Body>
void for_each_padded_cell(const Grid& grid, Body&& body) {
  for (int k = -grid.ghosts(2); k < grid.cells[2] + grid.ghosts(2); ++k)
    for (int j = -grid.ghosts(1); j < grid.cells[1] + grid.ghosts(1); ++j)
      for (int i = -grid.ghosts(0); i < grid.cells[0] + grid.ghosts(0); ++i) body(std::array<int, 3>{i, j, k});
}

Field named(const Grid& grid, double scale) {
  Field field = make_field(grid, -1);
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i)
        field[std::size_t(grid.index(i, j, k))] = scale * name_of(grid, {i, j, k});
  return field;
}

TEST(Blocks, ShareAllCellsAndHaveTheLeastSurface) {
  for (const Grid& whole : columns()) {
    const Grid block = block_of(whole, Ranks::of_program());
    EXPECT_EQ(sum_of_ranks(block, double(block.cell_count())), double(whole.cell_count()));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(block.column_cells(axis), whole.cells[std::size_t(axis)]);
      EXPECT_TRUE(!block.divided(axis) || block.cells[std::size_t(axis)] >= least_block_cells);
    }
  }
  EXPECT_EQ(choose_blocks(column(2, {20, 200, 1}, false), 4), (std::array<int, 3>{1, 4, 1}));  // 60, not 220 faces
  EXPECT_EQ(choose_blocks(column(2, {40, 40, 1}, false), 4), (std::array<int, 3>{2, 2, 1}));   // 80, not 120 faces
  EXPECT_EQ(choose_blocks(column(3, {32, 32, 32}, false), 8), (std::array<int, 3>{2, 2, 2}));
  EXPECT_THROW((void)choose_blocks(column(2, {6, 7, 1}, false), 2), CaseError);
}

TEST(Blocks, GhostsAreWhatTheOtherBlocksOwn) {
  for (const Grid& whole : columns()) {
    const Grid block = block_of(whole, Ranks::of_program());
    Field one = named(block, 1), two = named(block, 2);
    const Halo halo(block);
    for (int axis = 0; axis < block.dimensions; ++axis) halo.exchange(std::array<Field*, 2>{&one, &two}, axis);
    for_each_padded_cell(block, [&](const std::array<int, 3>& cell) {
      const auto at = std::size_t(block.index(cell[0], cell[1], cell[2]));
      const double name = name_of(block, cell);
      EXPECT_EQ(one[at], name) << cell[0] << ' ' << cell[1] << ' ' << cell[2];
      EXPECT_EQ(two[at], name < 0 ? -1 : 2 * name);
    });
  }
}

/// What the blocks own of a field on cells, as a field of the whole column on every rank.
Field gathered(const Grid& block, const Field& field) {
  const Grid whole = whole_column(block);
  Field all = make_field(whole);
  for (int k = 0; k < block.cells[2]; ++k)
    for (int j = 0; j < block.cells[1]; ++j)
      for (int i = 0; i < block.cells[0]; ++i)
        all[std::size_t(whole.index(i + block.before[0], j + block.before[1], k + block.before[2]))] =
            field[std::size_t(block.index(i, j, k))];
  add_over_ranks(block, all);
  return all;
}

TEST(Blocks, CellsAreNumberedOnceAndNeighboursAgree) {
  for (const Grid& whole : columns()) {
    const Grid block = block_of(whole, Ranks::of_program());
    const Field numbers = cell_numbers(block);
    Field place = named(block, 1);
    const Halo halo(block);
    for (int axis = 0; axis < block.dimensions; ++axis) halo.exchange(std::array<Field*, 1>{&place}, axis);
    // Numbers and places are two names of one cell: gathered, they pair off one to one.
    const Field all_numbers = gathered(block, numbers), all_places = gathered(block, place);
    std::vector<double> by_number(whole.cell_count(), -1);
    if (is_first(block.ranks.get()))
      for_each_row(whole, [&](Index b, Index e) {
        for (auto c = std::size_t(b); c < std::size_t(e); ++c) {
          double& known = by_number.at(std::size_t(all_numbers[c]));
          EXPECT_EQ(known, -1);
          known = all_places[c];
        }
      });
    take_from_first(block.ranks.get(), by_number);
    for (int axis = 0; axis < block.dimensions; ++axis)
      for_each_row(block, [&](Index b, Index e) {
        for (Index c = b; c < e; ++c)
          for (const Index step : {-block.stride(axis), block.stride(axis)}) {
            const double number = numbers[std::size_t(c + step)], name = place[std::size_t(c + step)];
            EXPECT_EQ(number < 0 ? -1 : by_number.at(std::size_t(number)), name);
          }
      });
  }
}

TEST(Ranks, ReduceAndAgree) {
  const Grid block = block_of(column(2, {40, 40, 1}, false), Ranks::of_program());
  const int count = block.ranks ? block.ranks->count() : 1, rank = block.ranks ? block.ranks->rank() : 0;
  EXPECT_EQ(sum_of_ranks(block, rank), count * (count - 1) / 2);
  EXPECT_EQ(greatest_of_ranks(block, rank), count - 1);
  EXPECT_EQ(least_of_ranks(block, -rank), 1 - count);
  EXPECT_EQ(on_all_ranks(block, rank < count - 1), false);
  EXPECT_EQ(on_any_rank(block.ranks.get(), rank == count - 1), true);
  EXPECT_EQ(rank_of_greatest(block, rank == 0 ? 1 : 2), count == 1 ? 0 : 1);
  EXPECT_EQ(said_by(block, count - 1, "rank " + std::to_string(rank)), "rank " + std::to_string(count - 1));
  std::vector<double> numbers{double(rank), 1};
  add_over_ranks(block, numbers);
  EXPECT_EQ(numbers, (std::vector<double>{count * (count - 1) / 2.0, double(count)}));
}

TEST(Ranks, ReduceManyNumbersInOneGo) {
  const auto ranks = Ranks::of_program();
  const int count = ranks ? ranks->count() : 1, rank = ranks ? ranks->rank() : 0;
  std::vector<double> mine{double(rank), 1}, nothing;
  std::vector<std::int64_t> whole{rank, 2}, more{(std::int64_t(1) << 60) / count};
  double high = rank, low = -rank, flat = 3;
  Reduction all;
  all.sum(mine);
  all.greatest(high);
  all.sum(whole);
  all.sum(nothing);
  all.greatest(low);
  all.sum(more);
  all.greatest(flat);
  all.over(ranks.get());
  const int sum = count * (count - 1) / 2;
  EXPECT_EQ(mine, (std::vector<double>{double(sum), double(count)}));
  EXPECT_EQ(whole, (std::vector<std::int64_t>{sum, 2 * count}));
  EXPECT_EQ(more, (std::vector<std::int64_t>{(std::int64_t(1) << 60) / count * count}));
  EXPECT_EQ(high, count - 1);
  EXPECT_EQ(low, 0);
  EXPECT_EQ(flat, 3);
}

// Terms of both signs over 17 decades. For at most 1300 terms both parts keep more than 45 digits below the greatest.
TEST(Ranks, ASumHasTheSameBitsHoweverTheColumnIsCut) {
  for (const Grid& whole : columns()) {
    const auto terms = [](const Grid& grid) {
      std::vector<double> values;
      const Field names = named(grid, 1);
      for_each_row(grid, [&](Index begin, Index end) {
        for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
          values.push_back(std::sin(names[c]) * std::exp(20 * std::cos(1.3 * names[c])));
      });
      return values;
    };
    const Grid block = block_of(whole, Ranks::of_program());
    const std::vector<double> all = terms(whole);
    long double exact = 0;
    double greatest = 0;
    for (const double term : all) {
      exact += term;
      greatest = std::max(greatest, std::abs(term));
    }
    const double sum = sum_of_ranks(block, terms(block));
    EXPECT_EQ(sum, sum_of_ranks(whole, all));
    EXPECT_NEAR(sum, double(exact), std::ldexp(greatest, -45) + std::ldexp(std::abs(sum), -53));
  }
  const auto ranks = Ranks::of_program();
  const std::vector<double> odd{is_first(ranks.get()) ? std::nan("") : 1.0}, endless{HUGE_VAL}, none;
  EXPECT_TRUE(std::isnan(sum_of_ranks(ranks.get(), odd)));
  EXPECT_TRUE(std::isnan(sum_of_ranks(ranks.get(), endless)));
  EXPECT_EQ(sum_of_ranks(ranks.get(), none), 0);
}

TEST(Ranks, AnErrorOfTheFirstIsThrownOnAll) {
  const auto ranks = Ranks::of_program();
  int worked = 0;
  on_first(ranks.get(), [&] { ++worked; });
  EXPECT_EQ(worked, is_first(ranks.get()) ? 1 : 0);
  EXPECT_THROW(on_first(ranks.get(), [] { throw FileError("full"); }), FileError);
  EXPECT_THROW(on_first(ranks.get(), [] { throw CaseError("wrong"); }), CaseError);
  EXPECT_THROW(on_first(ranks.get(), [] { throw NumericsError("not finite"); }), NumericsError);
  EXPECT_THROW(on_first(ranks.get(), [] { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_NO_THROW(on_all(ranks.get(), [] {}));
  const int last = ranks ? ranks->count() - 1 : 0;
  const auto failing_from = [&](int lowest) {
    const int here = ranks ? ranks->rank() : 0;
    try {
      on_all(ranks.get(), [&] {
        if (here >= lowest) throw NumericsError("rank " + std::to_string(here));
      });
    } catch (const NumericsError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(failing_from(last), "rank " + std::to_string(last));
  EXPECT_EQ(failing_from(0), "rank 0");
}

/// A coefficient that varies over three orders, from the place of the face.
FaceField coefficients(const Grid& grid, bool open_top) {
  FaceField b = make_face_field(grid);
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    Box box = owned_faces(grid, axis);
    if (!grid.ends(axis, 1)) ++box.hi[std::size_t(axis)];
    for (int k = box.lo[2]; k < box.hi[2]; ++k)
      for (int j = box.lo[1]; j < box.hi[1]; ++j)
        for (int i = box.lo[0]; i < box.hi[0]; ++i) {
          std::array<int, 3> at{i, j, k};
          const int along = at[std::size_t(axis)];
          const bool low = grid.ends(axis, 0) && along == 0,
                     high = grid.ends(axis, 1) && along == grid.cells[std::size_t(axis)];
          for (std::size_t a = 0; a < 3; ++a) at[a] = (at[a] + grid.before[a]) % grid.column_cells(int(a));
          double& value = b[std::size_t(axis)][std::size_t(grid.index(i, j, k))];
          value = std::exp(3 * std::sin(1.7 * at[0] + 0.9 * at[1] + 2.3 * at[2] + axis));
          if (low || (high && !(open_top && axis == 1))) value = 0;
        }
  }
  return b;
}

// In columns with few cells in a layer, setup and solution give the same bits as on one rank.
TEST(BlockSystem, HasTheBitsOfOneRank) {
  for (const Grid& whole : {columns()[0], columns()[1], columns()[2], column(3, {4, 26, 4}, false)}) {
    const auto solved = [](const Grid& grid, Field& p, Field& q) {
      const FaceField c11 = coefficients(grid, true), none = make_face_field(grid);
      FaceField c22 = coefficients(grid, false);
      for (Field& c : c22)
        for (double& value : c) value *= 0.3;
      BlockSolver solver(grid);
      ASSERT_TRUE(solver.setup(spans(c11), spans(none), spans(c22), spans(c22), named(grid, 1), {}, 2.0));
      solver.apply(named(grid, 1e-3), named(grid, 0.2), p, q, 2);
    };
    const Grid block = block_of(whole, Ranks::of_program());
    Field p = make_field(block), q = p, p_alone = make_field(whole), q_alone = p_alone;
    solved(block, p, q);
    solved(whole, p_alone, q_alone);
    for (const auto& [here, alone] : {std::pair{&p, &p_alone}, {&q, &q_alone}}) {
      const Field all = gathered(block, *here);
      if (!is_first(block.ranks.get())) continue;
      double most = 0;
      for_each_row(whole, [&](Index begin, Index end) {
        for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
          ASSERT_EQ(all[c], (*alone)[c]) << c;
          most = std::max(most, std::abs(all[c]));
        }
      });
      EXPECT_GT(most, 0);
    }
  }
}

TEST(Poisson, IsSolvedAcrossTheBlocks) {
  std::vector<Grid> wholes = columns();
  wholes.push_back(column(2, {80, 9, 1}, false));
  for (const Grid& whole : wholes)
    for (const bool open_top : {true, false}) {
      const Grid block = block_of(whole, Ranks::of_program());
      const FaceField b = coefficients(block, open_top), b_whole = coefficients(whole, open_top);
      const auto source = [](const Grid& g) {
        Field f = named(g, 1);
        for (double& v : f) v = std::sin(v);
        return f;
      };
      Field p = make_field(block), reference = make_field(whole);
      constexpr double tolerance = 1e-12;
      const PoissonResult here = PoissonSolver(block).solve(spans(b), {}, source(block), p, tolerance);
      const PoissonResult alone = PoissonSolver(whole).solve(spans(b_whole), {}, source(whole), reference, tolerance);
      EXPECT_TRUE(here.converged) << here.solver << ' ' << here.residual;
      EXPECT_TRUE(alone.converged) << alone.solver << ' ' << alone.residual;
      const Field all = gathered(block, p);
      if (!is_first(block.ranks.get())) continue;
      double most = 0, scale = 0;
      for_each_row(whole, [&](Index begin, Index end) {
        for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
          most = std::max(most, std::abs(all[c] - reference[c]));
          scale = std::max(scale, std::abs(reference[c]));
        }
      });
      // Up to 64 cells across each rank solves for the whole column. Beyond, the difference is at most the residual,
      // 1e-12, times the condition number of these small matrices, some 1e4.
      EXPECT_LE(most, whole.cells[0] <= 64 ? 0 : 1e-8 * scale) << whole.cells[0];
    }
}

}  // namespace
}  // namespace polybed::core

/// Only the first rank reports; a failure on any rank ends them all with 1.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const auto ranks = polybed::core::Ranks::of_program();
  const int failed = RUN_ALL_TESTS();
  const bool any = polybed::core::on_any_rank(ranks.get(), failed != 0);
  MPI_Finalize();
  return any ? 1 : 0;
}
