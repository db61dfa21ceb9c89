#include "app/stress_uncertainty.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/run_directory.hpp"
#include "core/case/file.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/output/output.hpp"
#include "core/print.hpp"
#include "measures/time_mean.hpp"
#include "multiscale/calibrate/moved_table.hpp"
#include "multiscale/compare_window.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;
constexpr std::string_view word = "table:";

/// A mean over the window in which runs are compared.
std::optional<double> late_mean(const core::History& history, const Series& values) {
  if (values.empty()) return {};
  const auto mean = measures::time_mean(within(history.of("time_s"), values, window_of(history)));
  return mean ? std::optional(mean->mean) : std::nullopt;
}

/// What is banded: bed height and normalised centre difference of a run.
struct Seen {
  std::optional<double> height, difference;
};

Seen seen(const fs::path& directory) {
  const core::History history = core::read_history(directory);
  return {late_mean(history, history.of("bed_height_m")),
          late_mean(history, centre_difference(history, species_of(history)))};
}

void write_band(core::Json& json, const char* name, const char* unit, const std::array<std::optional<double>, 3>& v) {
  if (!v[0] || !v[1] || !v[2]) return;
  const auto [least, most] = std::minmax({*v[0], *v[1], *v[2]});
  json.key(name).begin_object().member("table", *v[1]).member("minus", *v[0]).member("plus", *v[2]);
  json.member("low", least).member("high", most).end_object();
  core::print(stderr, "{}: {:.5g}{}, {:.5g} to {:.5g} within one standard error of the table\n", name, *v[1], unit,
              least, most);
}

}  // namespace

void require_table(const core::Scene& scene) {
  if (!core::law_of(scene, "solids_stress").starts_with(word))
    throw core::CaseError("--stress-uncertainty is that of a table: effects.solids_stress = \"table:FILE\"");
}

std::string hash_of_table(const core::Scene& scene) {
  const std::string stress = core::law_of(scene, "solids_stress");
  if (!stress.starts_with(word)) return "";
  const core::Bytes bytes = core::read_whole_file(stress.substr(word.size()));
  return core::text_hash({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string with_moved_table(const core::Scene& scene, const fs::path& directory, const std::string& name,
                             double sigma) {
  const fs::path table = core::law_of(scene, "solids_stress").substr(word.size());
  const fs::path moved = directory / ("table-" + name + ".h5");
  core::on_first(core::Ranks::of_program().get(), [&] { write_moved_table(table, sigma, moved); });
  return "effects.solids_stress=\"table:" + moved.string() + "\"";
}

void run_stress_uncertainty(const RunOptions& options) {
  const core::Scene scene = read_scene(options);
  const fs::path table = core::law_of(scene, "solids_stress").substr(word.size());
  const fs::path directory = run_directory(options, "tfm");
  const std::shared_ptr<const core::Ranks> ranks = core::Ranks::of_program();
  for (const auto& [name, sigma] : {std::pair("minus", -1.0), std::pair("plus", 1.0)}) {
    RunOptions run = options;
    run.output = directory / name;
    run.overrides.push_back(with_moved_table(scene, directory, name, sigma));
    run.stress_uncertainty = run.json = run.picture = false;
    run.resume = options.resume && has_checkpoint(run.output);
    run_tfm(run);
  }
  core::on_first(ranks.get(), [&] {
    const std::array<Seen, 3> all{seen(directory / "minus"), seen(directory), seen(directory / "plus")};
    core::Json json;
    json.begin_object().member("filetype", "polybed stress uncertainty").member("version", 1);
    json.member("table", table.string())
        .member("standard_errors", 1)
        .member("window", "last quarter, from where it is stationary");
    write_band(json, "bed_height_m", " m", {all[0].height, all[1].height, all[2].height});
    write_band(json, "centre_difference", "", {all[0].difference, all[1].difference, all[2].difference});
    core::write_atomically(directory / "stress_uncertainty.json", json.end_object().text() + "\n");
  });
}

}  // namespace polybed::multiscale
