// Writes a small run with known values, for the Python package to read and draw: write_sample_run DIRECTORY KIND.
// Two species in a column of 60 mm by 200 mm; the fine one rises above the coarse one. KIND: 2 or 3, fields in that
// many dimensions; particles, without a fluid; coupled, fields in two dimensions and particles.
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include "core/output/files.hpp"
#include "core/output/output.hpp"
#include "scenes/snapshot_profile.hpp"
#include "scenes/stored_steps.hpp"

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

FieldWriter field_writer(const std::filesystem::path& directory, const Grid& grid) {
  return {directory, grid, {{"voidage", false}, {"phi_fine", false}, {"phi_coarse", false}, {"u_fluid", true}}};
}

void write_fields(FieldWriter& fields, ProfileWriter& profiles, const Grid& grid, double time) {
  const SampleStep s = sample_step(grid, time);
  const FieldValues velocity(std::size_t(grid.dimensions), s.height);
  const std::vector<FieldValues> values{{s.voidage}, {s.fine}, {s.coarse}, velocity};
  fields.write_step(time, values);
  const std::vector<std::vector<double>> rows{lateral_mean(grid, s.fine), lateral_mean(grid, s.coarse),
                                              lateral_mean(grid, s.voidage)};
  profiles.write_row(time, rows);
}

ProfileWriter profile_writer(const std::filesystem::path& directory, const Grid& grid) {
  std::vector<double> heights;
  for (int j = 0; j < grid.cells[1]; ++j) heights.push_back(grid.centre(1, j));
  return {directory, heights, {"phi_fine", "phi_coarse", "voidage"}};
}

/// Particles on a lattice of 4 mm, 15 wide, 20 high, 2 deep: in every second place a coarse one of 4 mm (even rows) or
/// a fine one of 2 mm. All rise by 20 mm/s and turn by their id in rad/s; the first n have left at the n-th step.
ParticleStep sample_particles(int step, double time) {
  ParticleStep p;
  for (int place = 0; place < 600; place += 2) {
    if (place / 2 < step) continue;
    const int column = place % 15, row = place / 15 % 20, layer = place / 300;
    const bool fine = row % 2 == 1;
    p.id.push_back(place / 2);
    p.species.push_back(fine ? 0 : 1);
    p.radius.push_back(fine ? 1e-3 : 2e-3);
    p.position.push_back({0.002 + 0.004 * column, 0.002 + 0.004 * row + 0.02 * time, 0.002 + 0.004 * layer});
    p.velocity.push_back({0, 0.02, 0});
    p.spin.push_back({0, 0, double(place / 2)});
  }
  return p;
}

/// Profiles of particles alone: their volume fractions, velocities and granular temperatures.
struct ParticleProfiles {
  polybed::measures::Slabs slabs{0.06 * 0.008, 0.2, 60};
  ProfileWriter writer;

  explicit ParticleProfiles(const std::filesystem::path& directory)
      : writer(directory, centres(), {"phi_fine", "phi_coarse", "u_fine", "u_coarse", "theta_fine", "theta_coarse"}) {}
  [[nodiscard]] std::vector<double> centres() const {
    std::vector<double> y;
    for (std::size_t k = 0; k < slabs.count; ++k) y.push_back((double(k) + 0.5) * slabs.thickness());
    return y;
  }
  void write(double time, const ParticleSnapshot& particles) {
    const auto profile = polybed::measures::particle_profile(particles, 2, slabs);
    std::vector<std::vector<double>> rows = profile.solids.fraction;
    rows.insert(rows.end(), profile.velocity.begin(), profile.velocity.end());
    rows.insert(rows.end(), profile.temperature.begin(), profile.temperature.end());
    writer.write_row(time, rows);
  }
};

std::vector<std::string> history_columns(bool ledger) {
  std::vector<std::string> columns{"time_s", "bed_height_m", "centre_fine_m", "centre_coarse_m", "interface_m"};
  if (ledger)
    columns.insert(columns.end(), {"kinetic_J", "rotational_J", "elastic_J", "potential_J", "dissipated_J", "work_J",
                                   "contacts", "max_overlap_m", "max_contact_force_N"});
  return columns;
}

/// Energy falls and is dissipated: the ledger of these numbers closes.
void write_history(HistoryWriter& history, bool ledger, double time) {
  std::vector<std::optional<double>> row{time, 0.08 + 0.02 * time, 0.05 + 0.02 * time, 0.05 - 0.01 * time,
                                         std::nullopt};
  if (ledger)
    for (double value : {4 - 2 * time, 1.0, 1 - time, 10.0, 3 * time, 0.0, 100.0, 1e-6, 0.5}) row.emplace_back(value);
  history.write_row(row);
}

void write_run(const std::filesystem::path& directory, const std::string& kind) {
  const bool particles = kind == "particles" || kind == "coupled";
  const Grid grid = sample_grid(kind == "3" ? 3 : 2);
  make_directories(directory);
  std::optional<FieldWriter> fields;
  std::optional<ParticleWriter> solids;
  std::optional<ProfileWriter> profiles;
  std::optional<ParticleProfiles> particle_profiles;
  if (kind != "particles") {
    fields.emplace(field_writer(directory, grid));
    profiles.emplace(profile_writer(directory, grid));
  } else {
    particle_profiles.emplace(directory);
  }
  if (particles) solids.emplace(directory, ParticleScene{{0.06, 0.2, 0.008}, {false, false, true}, {"fine", "coarse"}});
  HistoryWriter history(directory, history_columns(particles));
  for (int n = 0; n <= 4; ++n) {
    const double time = 0.25 * n;
    if (fields) write_fields(*fields, *profiles, grid, time);
    const ParticleStep p = sample_particles(n, time);
    const ParticleSnapshot snapshot{p.id, p.species, p.radius, p.position, p.velocity, p.spin};
    if (solids) solids->write_step(time, snapshot);
    if (particle_profiles) particle_profiles->write(time, snapshot);
    write_history(history, particles, time);
  }
  const std::string model = particles ? "dem" : "tfm";
  write_atomically(directory / "run.json", R"({"filetype": "polybed run", "version": 1, "model": ")" + model +
                                               R"(", "state": "done", "case_hash": "0123456789abcdef"})");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  write_run(argv[1], argv[2]);
  return 0;
}
