#include "tfm/solids_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"
#include "core/output/file.hpp"
#include "core/output/files.hpp"

namespace polybed::tfm {

namespace {

const core::FileKind kind{"polybed solids table", 1};
constexpr const char* seal = "crc32";

constexpr double densest = 0.9;          ///< solids fraction of any mixture of spheres
constexpr double greatest_ratio = 1e3;   ///< measured: 0.03 to 2
constexpr double greatest_number = 1e6;  ///< of seeds, and of other numbers

std::uint32_t checksum(const core::OutputFile& table) {
  static_assert(std::endian::native == std::endian::little, "the checksum is over doubles with the low byte first");
  std::uint32_t sum = 0;
  for (const std::string& name : table.names("/")) {
    const std::vector<double> values = table.read(name).values;
    sum = core::crc32(std::as_bytes(std::span(values)), sum);
  }
  return sum;
}

/// Whether a table has a checksum; files from earlier versions have none.
bool is_sealed(const core::OutputFile& table) { return table.has_attribute("/", seal); }

/// Opens a table. Throws core::FileError for another kind of file, and for a wrong checksum.
core::OutputFile open_table(const std::filesystem::path& path) {
  core::OutputFile table(path, kind);
  if (is_sealed(table) && table.attribute("/", seal) != double(checksum(table)))
    throw core::FileError(fmt::format("{} is damaged: its checksum does not hold", path.string()));
  return table;
}

/// Writes a table with its checksum: CRC-32 over the numbers in all datasets, as doubles of 8 bytes with the low byte
/// first, in the order of the datasets' names.
void save_table(core::OutputFile& table, const std::filesystem::path& path) {
  table.set_attribute("/", seal, std::int64_t(checksum(table)));
  table.save(path);
}

/// The numbers along an axis; throws core::FileError unless the dataset has one dimension.
std::vector<double> read_axis(const core::OutputFile& table, const std::filesystem::path& path,
                              const std::string& name) {
  core::DataSet data = table.read(name);
  if (data.shape.size() != 1)
    throw core::FileError(
        fmt::format("{}: {} has {} dimensions, an axis has one", path.string(), name, data.shape.size()));
  return std::move(data.values);
}

/// The numbers in a dataset; throws core::FileError if its shape differs from the axes.
std::vector<double> read_shaped(const core::OutputFile& table, const std::filesystem::path& path,
                                const std::string& name, const std::vector<std::size_t>& shape) {
  core::DataSet data = table.read(name);
  if (data.shape != shape)
    throw core::FileError(fmt::format("{}: {} has the shape [{}], the axes say [{}]", path.string(), name,
                                      fmt::join(data.shape, ", "), fmt::join(shape, ", ")));
  return std::move(data.values);
}

/// Throws core::FileError unless all values are in a range, ends included; a NaN never is.
void require_range(const std::filesystem::path& path, const std::string& name, std::span<const double> values,
                   double least, double most) {
  for (std::size_t n = 0; n < values.size(); ++n)
    if (!(values[n] >= least && values[n] <= most))
      throw core::FileError(fmt::format("{}: {} number {} is {:g}: {:.3g} to {:.3g} is possible", path.string(), name,
                                        n + 1, values[n], least, most));
}

/// Throws core::FileError unless there are values, in a range and increasing.
void require_axis(const std::filesystem::path& path, const std::string& name, std::span<const double> values,
                  double least, double most) {
  if (values.empty()) throw core::FileError(fmt::format("{}: {} has no values", path.string(), name));
  require_range(path, name, values, least, most);
  for (std::size_t n = 1; n < values.size(); ++n)
    if (!(values[n] > values[n - 1])) throw core::FileError(fmt::format("{}: {} must rise", path.string(), name));
}

void require_quantity(const std::filesystem::path& path, const std::string& name, const TableQuantity& quantity) {
  require_range(path, name, quantity.value, std::numeric_limits<double>::min(), greatest_ratio);
  require_range(path, name + "_se", quantity.error, 0, greatest_ratio);
  require_range(path, name + "_n", quantity.seeds, 1, greatest_number);
}

/// Throws core::FileError for impossible values of p_bed; the law checks whether it increases.
void require_values(const std::filesystem::path& path, const BedPressure& bed) {
  require_range(path, "phi of p_bed", bed.phi, 0, densest);
  require_range(path, "p_bed", bed.pressure, 0, greatest_number);
  require_range(path, "p_bed_se", bed.error, 0, greatest_number);
}

/// Throws core::FileError for impossible values in a table of sheared particles.
void require_values(const std::filesystem::path& path, const SolidsTable& t) {
  constexpr double least = std::numeric_limits<double>::min();
  require_axis(path, "phi", t.phi, least, densest);
  require_axis(path, "stokes", t.stokes, t.stokes.size() > 1 ? least : 0, greatest_number);
  require_axis(path, "e", t.restitution, 0, 1);
  require_axis(path, "mu_p", t.friction, 0, 10);
  require_axis(path, "x2", t.share, 0, 1);
  require_quantity(path, "p_ratio", t.pressure);
  require_quantity(path, "mu_ratio", t.viscosity);
  require_quantity(path, "gamma_ratio", t.dissipation);
  require_quantity(path, "T_ratio_12", t.temperature);
  if (!t.exchange.value.empty()) require_quantity(path, "beta_12_ratio", t.exchange);
  require_range(path, "S", t.shear_number, 0, greatest_number);
  const std::array<double, 4> numbers{t.inertia, t.residual, t.left_out, t.exchange_drift};
  require_range(path, "lambda, fit_residual, left_out_residual or beta_12_drift", numbers, 0, greatest_number);
  require_range(path, "size_ratio", std::span(&t.size_ratio, 1), 1 / greatest_ratio, greatest_ratio);
  if (!t.bed.phi.empty()) require_values(path, t.bed);
}

/// Weights of the two knots around a value; outside, the edge's value.
struct Between {
  std::size_t low = 0, high = 0;
  double share = 0;  ///< share of the high one
};

Between between(const std::vector<double>& axis, double value) {
  if (axis.size() == 1 || value <= axis.front()) return {};
  if (value >= axis.back()) return {axis.size() - 1, axis.size() - 1, 0};
  const auto high = std::size_t(std::upper_bound(axis.begin(), axis.end(), value) - axis.begin());
  return {high - 1, high, (value - axis[high - 1]) / (axis[high] - axis[high - 1])};
}

/// A quantity along phi at one Stokes number, linear in the other axes.
std::vector<double> along_phi(const SolidsTable& t, const TableQuantity& q, std::size_t stokes,
                              const TablePlace& place) {
  const Between e = between(t.restitution, place.restitution), m = between(t.friction, place.friction),
                x = between(t.share, place.share);
  std::vector<double> values;
  for (std::size_t p = 0; p < t.phi.size(); ++p) {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const bool he = corner & 1, hm = corner & 2, hx = corner & 4;
      const double weight = (he ? e.share : 1 - e.share) * (hm ? m.share : 1 - m.share) * (hx ? x.share : 1 - x.share);
      const std::size_t n = t.index(p, stokes, he ? e.high : e.low, hm ? m.high : m.low, hx ? x.high : x.low);
      sum += weight * (q.value[n] + place.sigma * q.error[n]);
    }
    values.push_back(sum);
  }
  return values;
}

using Quantities = std::array<std::pair<const char*, TableQuantity SolidsTable::*>, 4>;
constexpr Quantities quantities{{{"p_ratio", &SolidsTable::pressure},
                                 {"mu_ratio", &SolidsTable::viscosity},
                                 {"gamma_ratio", &SolidsTable::dissipation},
                                 {"T_ratio_12", &SolidsTable::temperature}}};
using Axes = std::array<std::pair<const char*, std::vector<double> SolidsTable::*>, 5>;
constexpr Axes axes{{{"phi", &SolidsTable::phi},
                     {"stokes", &SolidsTable::stokes},
                     {"e", &SolidsTable::restitution},
                     {"mu_p", &SolidsTable::friction},
                     {"x2", &SolidsTable::share}}};
using Numbers = std::array<std::pair<const char*, double SolidsTable::*>, 4>;
constexpr Numbers numbers{{{"lambda", &SolidsTable::inertia},
                           {"size_ratio", &SolidsTable::size_ratio},
                           {"fit_residual", &SolidsTable::residual},
                           {"left_out_residual", &SolidsTable::left_out}}};
using Texts = std::array<std::pair<const char*, std::string SolidsTable::*>, 3>;
constexpr Texts texts{{{"reference", &SolidsTable::reference},
                       {"case_hash", &SolidsTable::case_hash},
                       {"created", &SolidsTable::created}}};

core::BoxRegime regime_of(const core::OutputFile& file, const std::filesystem::path& path) {
  const std::string name = file.text_attribute("/", "regime");
  for (const core::BoxRegime regime : {core::BoxRegime::dry, core::BoxRegime::wet, core::BoxRegime::bed})
    if (core::name_of(regime) == name) return regime;
  throw core::FileError(path.string() + ": a table of regime \"" + name + "\"; there are dry, wet and bed");
}

BedPressure bed_pressure(const core::OutputFile& file, const std::filesystem::path& path, const char* phi) {
  BedPressure bed{read_axis(file, path, phi), {}, {}};
  const std::vector<std::size_t> shape{bed.phi.size()};
  bed.pressure = read_shaped(file, path, "p_bed", shape);
  if (file.has("p_bed_se")) bed.error = read_shaped(file, path, "p_bed_se", shape);
  return bed;
}

}  // namespace

closures::StressRatios ratios_at(const SolidsTable& table, const TablePlace& place) {
  std::vector<closures::RatioCurves> curves;
  for (std::size_t s = 0; s < table.stokes.size(); ++s)
    curves.push_back({table.stokes[s],
                      {table.phi, along_phi(table, table.pressure, s, place)},
                      {table.phi, along_phi(table, table.viscosity, s, place)},
                      {table.phi, along_phi(table, table.dissipation, s, place)}});
  return closures::StressRatios(std::move(curves));
}

closures::MonotoneCurve exchange_at(const SolidsTable& table, const TablePlace& place) {
  if (table.exchange.value.empty()) throw std::invalid_argument("a table without an exchange of species");
  return {table.phi, along_phi(table, table.exchange, 0, place)};
}

TablePlace place_of(const core::Scene& scene) {
  const std::vector<double>& share = scene.bed.volume_share;
  TablePlace place;
  for (std::size_t j = 0; j < scene.species.size(); ++j) {
    place.restitution += share[j] * scene.species[j].restitution;
    place.friction += share[j] * scene.species[j].friction;
  }
  if (scene.species.size() != 2) return place;
  place.share = share[1];
  place.size_ratio = scene.species[1].diameter / scene.species[0].diameter;
  return place;
}

std::vector<std::string> beyond(const SolidsTable& table, const TablePlace& place) {
  constexpr double rounding = 1e-9;
  std::vector<std::string> lines;
  const auto hold = [&](const char* name, const std::vector<double>& axis, double value) {
    if (value >= axis.front() - rounding && value <= axis.back() + rounding) return;
    lines.push_back(fmt::format("{} {:.4g} lies outside the table's {:.4g} to {:.4g}: its edge is held", name, value,
                                axis.front(), axis.back()));
  };
  if (table.regime == core::BoxRegime::dry) hold("restitution", table.restitution, place.restitution);
  hold("friction", table.friction, place.friction);
  if (!table.of_two_species()) return lines;
  hold("share of the second species", table.share, place.share);
  if (std::abs(place.size_ratio - table.size_ratio) > rounding * table.size_ratio)
    lines.push_back(fmt::format("the sizes of the species are as 1 to {:.4g}, those of the table as 1 to {:.4g}",
                                place.size_ratio, table.size_ratio));
  return lines;
}

core::BoxRegime regime_of_table(const std::filesystem::path& path) { return regime_of(open_table(path), path); }

std::string missing_checksum(const std::filesystem::path& path) {
  if (is_sealed(open_table(path))) return "";
  return path.string() + " carries no checksum: it is of an earlier version, and damage to it would not be noticed";
}

void write_solids_table(const std::filesystem::path& path, const SolidsTable& table) {
  core::OutputFile file = core::OutputFile(kind);
  file.set_attribute("/", "regime", std::string(core::name_of(table.regime)));
  for (const auto& [name, text] : texts) file.set_attribute("/", name, table.*text);
  for (const auto& [name, number] : numbers) file.set_attribute("/", name, table.*number);
  file.set_attribute("/", "units", std::string("ratios to the reference; p_bed over |rho_p - rho_f| g D"));
  std::vector<std::size_t> shape;
  for (const auto& [name, axis] : axes) {
    shape.push_back((table.*axis).size());
    file.write(name, {shape.back()}, table.*axis);
  }
  for (const auto& [name, quantity] : quantities) {
    const TableQuantity& q = table.*quantity;
    file.write(name, shape, q.value);
    file.write(std::string(name) + "_se", shape, q.error);
    file.write(std::string(name) + "_n", shape, q.seeds);
  }
  if (!table.exchange.value.empty()) {
    file.write("beta_12_ratio", shape, table.exchange.value);
    file.write("beta_12_ratio_se", shape, table.exchange.error);
    file.write("beta_12_ratio_n", shape, table.exchange.seeds);
    file.write("beta_12_drift", {1}, std::vector{table.exchange_drift});
  }
  file.write("S", shape, table.shear_number);
  if (!table.bed.phi.empty()) {
    file.write("phi_bed", {table.bed.phi.size()}, table.bed.phi);
    file.write("p_bed", {table.bed.phi.size()}, table.bed.pressure);
    file.write("p_bed_se", {table.bed.phi.size()}, table.bed.error);
  }
  save_table(file, path);
}

SolidsTable read_solids_table(const std::filesystem::path& path) {
  const core::OutputFile file = open_table(path);
  SolidsTable table;
  table.regime = regime_of(file, path);
  if (table.regime == core::BoxRegime::bed)
    throw core::FileError(path.string() + ": a table of regime \"bed\" holds no sheared boxes");
  for (const auto& [name, text] : texts) table.*text = file.text_attribute("/", name);
  for (const auto& [name, number] : numbers) table.*number = file.attribute("/", name);
  std::vector<std::size_t> shape;
  for (const auto& [name, axis] : axes) {
    table.*axis = read_axis(file, path, name);
    shape.push_back((table.*axis).size());
  }
  const auto quantity_of = [&](const std::string& name) {
    return TableQuantity{read_shaped(file, path, name, shape), read_shaped(file, path, name + "_se", shape),
                         read_shaped(file, path, name + "_n", shape)};
  };
  for (const auto& [name, quantity] : quantities) table.*quantity = quantity_of(name);
  table.shear_number = read_shaped(file, path, "S", shape);
  table.git_commit = file.text_attribute("/", "git_commit");
  if (file.has("beta_12_drift")) {  // older files have ratios to another form, for slow drift
    table.exchange = quantity_of("beta_12_ratio");
    table.exchange_drift = read_shaped(file, path, "beta_12_drift", {1}).front();
    require_range(path, "beta_12_drift", std::span(&table.exchange_drift, 1), 0, std::numeric_limits<double>::max());
  }
  if (file.has("p_bed")) table.bed = bed_pressure(file, path, "phi_bed");
  require_values(path, table);
  return table;
}

BedPressure read_bed_table(const std::filesystem::path& path) {
  BedPressure bed = bed_pressure(open_table(path), path, "phi");
  require_values(path, bed);
  return bed;
}

}  // namespace polybed::tfm
