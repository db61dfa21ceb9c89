// Writes a small run with known values, for the Python package to read and draw: write_sample_run DIRECTORY
// DIMENSIONS. Two species in a column of 60 mm by 200 mm; the fine one rises above the coarse one.
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/files.hpp"
#include "core/output.hpp"

namespace {

using namespace polybed::core;

Grid sample_grid(int dimensions) {
  Grid grid;
  grid.dimensions = dimensions;
  grid.cells = {18, 60, dimensions == 3 ? 4 : 1};
  grid.spacing = {0.06 / 18, 0.2 / 60, 0.004};
  return grid;
}

/// Volume fraction of a species whose layer is centred at a height and waves along x.
double fraction(double x, double y, double centre, double most) {
  const double distance = (y - centre - 0.006 * std::cos(100 * x)) / 0.03;
  return most * std::exp(-distance * distance * distance * distance);
}

struct SampleStep {
  Field fine, coarse, voidage, height;
};

SampleStep sample_step(const Grid& grid, double time) {
  SampleStep s{make_field(grid), make_field(grid), make_field(grid), make_field(grid)};
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i) {
        const auto c = std::size_t(grid.index(i, j, k));
        const double x = grid.centre(0, i), y = grid.centre(1, j);
        s.fine[c] = fraction(x, y, 0.05 + 0.02 * time, 0.30);
        s.coarse[c] = fraction(x, y, 0.05 - 0.01 * time, 0.25);
        s.voidage[c] = 1 - s.fine[c] - s.coarse[c];
        s.height[c] = y;
      }
  return s;
}

std::vector<double> lateral_mean(const Grid& grid, const Field& field) {
  std::vector<double> mean(std::size_t(grid.cells[1]), 0.0);
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i)
        mean[std::size_t(j)] += field[std::size_t(grid.index(i, j, k))] / (grid.cells[0] * grid.cells[2]);
  return mean;
}

void write_run(const std::filesystem::path& directory, const Grid& grid) {
  make_directories(directory);
  FieldWriter fields(directory, grid,
                     {{"voidage", false}, {"phi_fine", false}, {"phi_coarse", false}, {"u_fluid", true}});
  std::vector<double> heights;
  for (int j = 0; j < grid.cells[1]; ++j) heights.push_back(grid.centre(1, j));
  ProfileWriter profiles(directory, heights, {"phi_fine", "phi_coarse", "voidage"});
  HistoryWriter history(directory, {"time_s", "bed_height_m", "centre_fine_m", "centre_coarse_m", "interface_m"});
  for (int n = 0; n <= 4; ++n) {
    const double time = 0.25 * n;
    const SampleStep s = sample_step(grid, time);
    const FieldValues velocity(std::size_t(grid.dimensions), s.height);
    const std::vector<FieldValues> values{{s.voidage}, {s.fine}, {s.coarse}, velocity};
    fields.write_step(time, values);
    const std::vector<std::vector<double>> rows{lateral_mean(grid, s.fine), lateral_mean(grid, s.coarse),
                                                lateral_mean(grid, s.voidage)};
    profiles.write_row(time, rows);
    const std::vector<std::optional<double>> row{time, 0.08 + 0.02 * time, 0.05 + 0.02 * time, 0.05 - 0.01 * time,
                                                 std::nullopt};
    history.write_row(row);
  }
  write_atomically(directory / "run.json",
                   R"({"filetype": "polybed run", "version": 1, "model": "tfm", "state": "done"})");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  write_run(argv[1], sample_grid(std::atoi(argv[2])));
  return 0;
}
