#include "multiscale/effects/audit.hpp"

#include <nlohmann/json.hpp>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/fields.hpp"
#include "core/output/json.hpp"
#include "core/output/particles.hpp"
#include "multiscale/effects/fluid_map.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/run_record.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;
using closures::Vec3;

/// A stored vector field as vectors; of a plane the third component is 0.
std::vector<Vec3> vectors(const core::DataSet& data) {
  const std::size_t components = data.shape.back();
  std::vector<Vec3> result(data.values.size() / components);
  for (std::size_t c = 0; c < result.size(); ++c) {
    const double* v = data.values.data() + components * c;
    result[c] = {v[0], v[1], components > 2 ? v[2] : 0};
  }
  return result;
}

FluidMap map_of(const core::FieldReader& reader, const core::Scene& scene, std::size_t step) {
  FluidMap map;
  map.dimensions = scene.column.dimensions;
  map.walls = scene.column.sides == core::Boundary::wall;
  for (int axis = 0; axis < map.dimensions; ++axis) {
    const std::vector<double> faces = reader.faces(axis);
    map.cells[std::size_t(axis)] = int(faces.size()) - 1;
    map.spacing[std::size_t(axis)] = faces[1] - faces[0];
  }
  map.velocity = vectors(reader.field(step, "u_fluid"));
  return map;
}

void audit_continuum(const core::FieldReader& reader, const core::Scene& scene, std::size_t step,
                     Neglected& neglected) {
  const FluidMap map = map_of(reader, scene, step);
  for (std::size_t j = 0; j < scene.species.size(); ++j) {
    const std::string& name = scene.species[j].name;
    const std::vector<double> fraction = reader.field(step, "phi_" + name).values;
    const std::vector<Vec3> velocity = vectors(reader.field(step, "u_" + name));
    for (int k = 0; k < map.cells[2]; ++k)
      for (int i = 0; i < map.cells[1]; ++i)
        for (int h = 0; h < map.cells[0]; ++h) {
          const std::size_t c = map.index(h, i, k);
          if (!(fraction[c] > least_fraction_met)) continue;
          Encounter met{j, map.velocity[c] - velocity[c], map.vorticity({h, i, k}), {}, {}, reader.times()[step]};
          met.place = {(h + 0.5) * map.spacing[0], (i + 0.5) * map.spacing[1],
                       map.dimensions > 2 ? (k + 0.5) * map.spacing[2] : 0};
          neglected.see(met);
        }
  }
}

void audit_particles(const core::FieldReader& reader, const core::ParticleReader& particles, const core::Scene& scene,
                     std::size_t step, Neglected& neglected) {
  const FluidMap map = map_of(reader, scene, step);
  const core::ParticleStep now = particles.step(step);
  for (std::size_t i = 0; i < now.id.size(); ++i) {
    const auto& v = now.velocity[i];
    const auto& w = now.spin[i];
    neglected.see({std::size_t(now.species[i]), map.velocity_at(now.position[i]) - Vec3{v[0], v[1], v[2]},
                   map.vorticity(map.cell_at(now.position[i])), Vec3{w[0], w[1], w[2]}, now.position[i],
                   reader.times()[step]});
  }
}

}  // namespace

Neglected audit_run(const fs::path& directory) {
  const core::Json record = read_run_record(directory);
  const std::string model = core::text_of(core::member_of(record, "model"));
  const core::Scene scene = core::parse_case(core::text_of(core::member_of(record, "case")),
                                             (directory / "run.json").string(), {}, all_roles(), size_classes);
  Neglected neglected(scene, model);
  const core::FieldReader reader(directory);
  std::optional<core::ParticleReader> particles;
  if (model == "dem") particles.emplace(directory);
  for (std::size_t step = 0; step < reader.times().size(); ++step) {
    if (!(reader.times()[step] > 0)) continue;
    particles ? audit_particles(reader, *particles, scene, step, neglected)
              : audit_continuum(reader, scene, step, neglected);
  }
  if (neglected.sum().count + neglected.sum().outside == 0)
    throw core::FileError(directory.string() + ": no stored step to audit");
  return neglected;
}

}  // namespace polybed::multiscale
