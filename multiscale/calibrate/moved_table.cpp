#include "multiscale/calibrate/moved_table.hpp"

#include <fmt/format.h>

#include "closures/stress_table.hpp"
#include "core/error.hpp"
#include "core/output/file.hpp"
#include "fluid/solids_table.hpp"
#include "fluid/solids_table_file.hpp"
#include "multiscale/calibrate/table_shape.hpp"

namespace polybed::multiscale {

namespace {

std::vector<double> moved_by(const std::vector<double>& values, const std::vector<double>& errors, double sigma) {
  std::vector<double> moved = values;
  for (std::size_t n = 0; n < moved.size(); ++n) moved[n] += sigma * errors[n];
  return moved;
}

/// A table of regime "bed" alone.
void write_moved_bed(const std::filesystem::path& path, double sigma, const std::filesystem::path& moved) {
  const fluid::BedPressure bed = fluid::read_bed_table(path);
  if (bed.error.empty()) throw core::CaseError(path.string() + ": no p_bed_se: nothing tells how uncertain p_bed is");
  const std::vector<double> pressure = moved_by(bed.pressure, bed.error, sigma);
  core::OutputFile file = fluid::new_table();
  file.set_attribute("/", "regime", std::string(core::name_of(core::BoxRegime::bed)));
  file.write("phi", {bed.phi.size()}, bed.phi);
  file.write("p_bed", {pressure.size()}, pressure);
  fluid::save_table(file, moved);
}

}  // namespace

void write_moved_table(const std::filesystem::path& path, double sigma, const std::filesystem::path& moved) {
  if (fluid::regime_of_table(path) == core::BoxRegime::bed) return write_moved_bed(path, sigma, moved);
  fluid::SolidsTable table = fluid::read_solids_table(path);
  for (fluid::TableQuantity* q : {&table.pressure, &table.viscosity}) q->value = moved_by(q->value, q->error, sigma);
  table.bed.pressure = moved_by(table.bed.pressure, table.bed.error, sigma);
  if (const auto falls = falls_of(table); !falls.empty())
    throw core::CaseError(
        fmt::format("{} moved by {:+g} standard errors: its pressure falls {}", path.string(), sigma, falls.front()));
  fluid::write_solids_table(moved, table);
}

}  // namespace polybed::multiscale
