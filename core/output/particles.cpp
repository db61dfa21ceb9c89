#include "core/output/particles.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include "core/error.hpp"

namespace polybed::core {

namespace {

namespace fs = std::filesystem;

using Vectors = std::span<const std::array<double, 3>>;

const FileKind particles_kind{"polybed particles", 1};
const FileKind particles_step_kind{"polybed particles step", 1};

void write_scene(const ParticleScene& scene, OutputFile& file) {
  const std::array<std::int32_t, 3> periodic{scene.periodic[0], scene.periodic[1], scene.periodic[2]};
  file.write("column/size", {3}, scene.size);
  file.write("column/periodic", {3}, std::span<const std::int32_t>(periodic));
  file.set_attribute("/", "species_names", scene.species);
}

ParticleScene read_scene(const OutputFile& file) {
  ParticleScene scene;
  const DataSet size = file.read("column/size");
  const std::vector<std::int64_t> periodic = file.read_integers("column/periodic");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    scene.size[axis] = size.values.at(axis);
    scene.periodic[axis] = periodic.at(axis) != 0;
  }
  scene.species = file.texts_attribute("/", "species_names");
  return scene;
}

template <class Shown>
void check_shape(const Shown& p, std::size_t species, std::initializer_list<std::size_t> lengths) {
  const std::size_t n = p.id.size();
  for (const std::size_t length : lengths)
    if (length != n)
      throw std::invalid_argument(fmt::format("{} particles, but {} entries of another kind", n, length));
  for (std::size_t i = 1; i < n; ++i)
    if (p.id[i] <= p.id[i - 1])
      throw std::invalid_argument(
          fmt::format("particles are not in the order of ids: {} before {}", p.id[i - 1], p.id[i]));
  for (std::size_t i = 0; i < n; ++i)
    if (p.species[i] < 0 || std::size_t(p.species[i]) >= species)
      throw std::invalid_argument(fmt::format("particle {} is of species {}, of {}", p.id[i], p.species[i], species));
}

[[noreturn]] void refuse(const char* quantity, std::int64_t id, double value, double time) {
  throw NumericsError(fmt::format("{} of particle {} is {} at t = {} s: not written", quantity, id, value, time));
}

void check_finite(const ParticleSnapshot& p, double time) {
  const std::array<std::pair<const char*, Vectors>, 3> vectors{
      {{"position", p.position}, {"velocity", p.velocity}, {"spin", p.spin}}};
  for (std::size_t i = 0; i < p.id.size(); ++i) {
    if (!std::isfinite(p.radius[i])) refuse("radius", p.id[i], p.radius[i], time);
    for (const auto& [name, values] : vectors) require_finite(name, p.id[i], values[i], time);
  }
}

void write_vectors(OutputFile& file, const std::string& name, Vectors values) {
  const std::span<const double> flat(values.empty() ? nullptr : values.front().data(), 3 * values.size());
  file.write(name, {values.size(), 3}, flat, Packing::if_small);
}

/// ParaView shows only the points in a list of points: write a list of all.
void write_connectivity(OutputFile& file, std::size_t count) {
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  file.write("paraview/connectivity", {count}, numbers, Packing::small);
}

/// Writes everything except the vectors.
template <class Shown>
OutputFile step_head(const ParticleScene& scene, const Shown& p, double time) {
  OutputFile file(particles_step_kind);
  file.make_group("step");
  file.set_attribute("step", "time_s", time);
  file.set_attribute("step", "species_names", scene.species);
  const std::vector<std::size_t> shape{p.id.size()};
  file.write("step/id", shape, p.id, Packing::small);
  file.write("step/species", shape, p.species, Packing::small);
  file.write("step/radius", shape, p.radius, Packing::small);
  write_connectivity(file, p.id.size());
  return file;
}

struct XdmfData {
  const char *name, *type;  ///< type: "Scalar" or "Vector"; null: no attribute
  const char *number, *precision, *place;
};

std::string data_item(const XdmfData& data, const std::string& file, std::size_t count) {
  const bool vector = data.type != nullptr && data.type == std::string_view("Vector");
  return fmt::format(R"(<DataItem Dimensions="{}{}" NumberType="{}" Precision="{}" Format="HDF">{}:/{}</DataItem>)",
                     count, vector ? " 3" : "", data.number, data.precision, file, data.place);
}

std::string step_xdmf(std::size_t step, double time, std::size_t count) {
  static constexpr std::array<XdmfData, 5> attributes{{{"id", "Scalar", "Int", "8", "step/id"},
                                                       {"species", "Scalar", "Int", "4", "step/species"},
                                                       {"radius", "Scalar", "Float", "8", "step/radius"},
                                                       {"velocity", "Vector", "Float", "8", "step/velocity"},
                                                       {"spin", "Vector", "Float", "8", "step/spin"}}};
  const std::string file = fmt::format("particles/{}.h5", step_name(step));
  std::string text = fmt::format(
      "      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n"
      "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\">\n          {}\n"
      "        </Topology>\n        <Geometry GeometryType=\"XYZ\">\n          {}\n        </Geometry>\n",
      step_name(step), time, count, data_item({"", nullptr, "Int", "8", "paraview/connectivity"}, file, count),
      data_item({"", "Vector", "Float", "8", "step/position"}, file, count));
  for (const XdmfData& data : attributes)
    text += fmt::format(
        "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">\n          {}\n        </Attribute>\n",
        data.name, data.type, data_item(data, file, count));
  return text + "      </Grid>\n";
}

std::string particles_xdmf(const StepTimes& steps) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"particles\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t step = 0; step < steps.time.size(); ++step)
    text += step_xdmf(step, steps.time[step], std::size_t(steps.count[step]));
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

StepSeries particles_series(const ParticleScene& scene) {
  return {"particles",
          particles_kind,
          [scene](OutputFile& file) { write_scene(scene, file); },
          [scene](const OutputFile& file) { return read_scene(file) == scene; },
          "column or other species",
          "particles",
          particles_xdmf};
}

}  // namespace

void require_finite(const char* quantity, std::int64_t id, const std::array<double, 3>& value, double time_s) {
  constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  for (std::size_t a = 0; a < 3; ++a)
    if (!std::isfinite(value[a])) refuse(fmt::format("{} {}", quantity, axes[a]).c_str(), id, value[a], time_s);
}

ParticleWriter::ParticleWriter(const fs::path& run_directory, ParticleScene scene, std::optional<double> resume_time,
                               std::shared_ptr<const Ranks> ranks)
    : directory_(run_directory), scene_(std::move(scene)), ranks_(std::move(ranks)) {
  on_first(ranks_.get(), [&] { steps_.emplace(run_directory, particles_series(scene_), resume_time); });
}

void ParticleWriter::write_step(double time_s, const ParticleSnapshot& p) {
  check_shape(p, scene_.species.size(),
              {p.species.size(), p.radius.size(), p.position.size(), p.velocity.size(), p.spin.size()});
  check_finite(p, time_s);
  OutputFile file = step_head(scene_, p, time_s);
  write_vectors(file, "step/position", p.position);
  write_vectors(file, "step/velocity", p.velocity);
  write_vectors(file, "step/spin", p.spin);
  steps_->add(file, time_s, p.id.size());
}

void ParticleWriter::write_step(double time_s, const ParticleHead& head, std::vector<BlockData> vectors) {
  for (BlockData& block : vectors) {
    block.name = "step/" + block.name;
    block.packing = Packing::if_small;
  }
  double number = 0;
  std::optional<OutputFile> file;
  on_first(ranks_.get(), [&] {
    check_shape(head, scene_.species.size(), {head.species.size(), head.radius.size()});
    for (std::size_t i = 0; i < head.id.size(); ++i)
      if (!std::isfinite(head.radius[i])) refuse("radius", head.id[i], head.radius[i], time_s);
    file.emplace(step_head(scene_, head, time_s));
    number = double(times().size());
  });
  take_from_first(ranks_.get(), std::span(&number, 1));
  const fs::path path = step_path(directory_, "particles", std::size_t(number)), fresh = path.string() + ".temporary";
  write_blocks(fresh, file ? &*file : nullptr, vectors, ranks_.get());
  on_first(ranks_.get(), [&] {
    put_in_place(fresh, path);
    steps_->add_written(time_s, head.id.size());
  });
}

}  // namespace polybed::core
