#include "tfm/solids_table_file.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "core/error.hpp"
#include "core/output/files.hpp"

namespace polybed::tfm {

namespace {

const core::FileKind kind{"polybed solids table", 1};
constexpr const char* seal = "crc32";

constexpr double densest = 0.9;          ///< solids fraction of any mixture of spheres
constexpr double greatest_ratio = 1e3;   ///< measured are 0.03 to 2
constexpr double greatest_number = 1e6;  ///< of seeds, and of what is no ratio

std::uint32_t checksum(const core::OutputFile& table) {
  static_assert(std::endian::native == std::endian::little, "the checksum is over doubles with the low byte first");
  std::uint32_t sum = 0;
  for (const std::string& name : table.names("/")) {
    const std::vector<double> values = table.read(name).values;
    sum = core::crc32(std::as_bytes(std::span(values)), sum);
  }
  return sum;
}

void require_size(const std::filesystem::path& path, const std::string& name, std::size_t found, std::size_t wanted) {
  if (found != wanted)
    throw core::FileError(fmt::format("{}: {} has {} values, the axes say {}", path.string(), name, found, wanted));
}

void require_quantity(const std::filesystem::path& path, const std::string& name, const TableQuantity& quantity,
                      std::size_t points) {
  require_size(path, name, quantity.value.size(), points);
  require_size(path, name + "_se", quantity.error.size(), points);
  require_size(path, name + "_n", quantity.seeds.size(), points);
  require_range(path, name, quantity.value, std::numeric_limits<double>::min(), greatest_ratio);
  require_range(path, name + "_se", quantity.error, 0, greatest_ratio);
  require_range(path, name + "_n", quantity.seeds, 1, greatest_number);
}

}  // namespace

core::OutputFile open_table(const std::filesystem::path& path) {
  core::OutputFile table(path, kind);
  if (is_sealed(table) && table.attribute("/", seal) != double(checksum(table)))
    throw core::FileError(fmt::format("{} is damaged: its checksum does not hold", path.string()));
  return table;
}

bool is_sealed(const core::OutputFile& table) { return table.has_attribute("/", seal); }

void save_table(core::OutputFile& table, const std::filesystem::path& path) {
  table.set_attribute("/", seal, std::int64_t(checksum(table)));
  table.save(path);
}

core::OutputFile new_table() { return core::OutputFile(kind); }

void require_range(const std::filesystem::path& path, const std::string& name, std::span<const double> values,
                   double least, double most) {
  for (std::size_t n = 0; n < values.size(); ++n)
    if (!(values[n] >= least && values[n] <= most))
      throw core::FileError(fmt::format("{}: {} number {} is {:g}: {:.3g} to {:.3g} is possible", path.string(), name,
                                        n + 1, values[n], least, most));
}

void require_axis(const std::filesystem::path& path, const std::string& name, std::span<const double> values,
                  double least, double most) {
  if (values.empty()) throw core::FileError(fmt::format("{}: {} has no values", path.string(), name));
  require_range(path, name, values, least, most);
  for (std::size_t n = 1; n < values.size(); ++n)
    if (!(values[n] > values[n - 1])) throw core::FileError(fmt::format("{}: {} must rise", path.string(), name));
}

void require_values(const std::filesystem::path& path, const SolidsTable& t) {
  constexpr double least = std::numeric_limits<double>::min();
  require_axis(path, "phi", t.phi, least, densest);
  require_axis(path, "stokes", t.stokes, t.stokes.size() > 1 ? least : 0, greatest_number);
  require_axis(path, "e", t.restitution, 0, 1);
  require_axis(path, "mu_p", t.friction, 0, 10);
  require_axis(path, "x2", t.share, 0, 1);
  require_quantity(path, "p_ratio", t.pressure, t.size());
  require_quantity(path, "mu_ratio", t.viscosity, t.size());
  require_quantity(path, "gamma_ratio", t.dissipation, t.size());
  require_quantity(path, "T_ratio_12", t.temperature, t.size());
  if (!t.exchange.value.empty()) require_quantity(path, "beta_12_ratio", t.exchange, t.size());
  require_size(path, "S", t.shear_number.size(), t.size());
  require_range(path, "S", t.shear_number, 0, greatest_number);
  const std::array<double, 4> numbers{t.inertia, t.residual, t.left_out, t.exchange_drift};
  require_range(path, "lambda, fit_residual, left_out_residual or beta_12_drift", numbers, 0, greatest_number);
  require_range(path, "size_ratio", std::span(&t.size_ratio, 1), 1 / greatest_ratio, greatest_ratio);
  if (!t.bed.phi.empty()) require_values(path, t.bed);
}

void require_values(const std::filesystem::path& path, const BedPressure& bed) {
  require_range(path, "phi of p_bed", bed.phi, 0, densest);
  require_size(path, "p_bed", bed.pressure.size(), bed.phi.size());
  require_range(path, "p_bed", bed.pressure, 0, greatest_number);
  if (!bed.error.empty()) require_size(path, "p_bed_se", bed.error.size(), bed.phi.size());
  require_range(path, "p_bed_se", bed.error, 0, greatest_number);
}

}  // namespace polybed::tfm
