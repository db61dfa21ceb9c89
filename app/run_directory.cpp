#include "app/run_directory.hpp"

#include <fmt/format.h>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/print.hpp"
#include "multiscale/roles.hpp"

namespace polybed::app {

namespace {

namespace fs = std::filesystem;

core::Checkpoint read_newest_checkpoint(const fs::path& directory) {
  const fs::path path = checkpoint_path(directory), previous = core::previous_checkpoint(path);
  try {
    return core::read_checkpoint(path);
  } catch (const core::FileError& error) {
    core::Checkpoint checkpoint;
    try {
      checkpoint = core::read_checkpoint(previous);
    } catch (const core::FileError&) {
      throw core::FileError(fmt::format("{}; there is no whole one before it: --force begins anew", error.what()));
    }
    fs::rename(previous, path);
    core::print(stderr, "{}\ngoing on from it\n", error.what());
    return checkpoint;
  }
}

/// The part of a case that must agree with a checkpoint: everything except its end and its output times.
std::string physics_hash(core::Scene scene) {
  scene.run.until = 1;
  scene.output = {};
  scene.inversion = {};
  return core::case_hash(scene);
}

/// A scene without effects that the checkpoint's case lacks and that can be added to its run.
core::Scene without_added(core::Scene scene, const std::string& before, const std::string& model) {
  const core::Scene then = core::parse_case(before, "checkpoint", {}, all_roles(), size_classes);
  std::erase_if(scene.effects, [&](const auto& entry) {
    const relevance::MenuEntry* effect = find_entry(entry.first);
    return !then.effects.contains(entry.first) && effect != nullptr && can_be_added(*effect, model);
  });
  scene.chooser = then.chooser;  // its choice is made and is compared
  return scene;
}

}  // namespace

core::Scene read_scene(const RunOptions& options, const Models& models) {
  std::vector<std::string> overrides = options.overrides;
  if (!options.until.empty() && !options.until_steady()) {
    const bool text = options.until.find_first_not_of("0123456789.eE+-") != std::string::npos;
    overrides.push_back("run.until=" + (text ? "\"" + options.until + "\"" : options.until));
  }
  core::Scene scene = read_chosen_case(options.case_path, overrides, models);
  if (options.until_steady() && scene.flows_around())
    throw core::CaseError(
        "--until steady waits for the height of a bed, and a box with column.ends = \"periodic\" has none: give "
        "a time, for example --until 10");
  if (options.until.empty() || options.until_steady()) return scene;
  try {  // checkpoints are part of the result: they do not move with --until
    scene.output.checkpoint_every =
        read_chosen_case(options.case_path, options.overrides, models).output.checkpoint_every;
  } catch (const core::CaseError&) {  // a case that needs --until
  }
  return scene;
}

fs::path default_run_directory(const fs::path& case_path, const std::string& model) {
  const fs::path path = fs::absolute(case_path);
  const std::string name = path.stem() == "case" ? path.parent_path().filename().string() : path.stem().string();
  return fs::path("runs") / (name + "-" + model);
}

fs::path run_directory(const RunOptions& options, const std::string& model) {
  return options.output.empty() ? default_run_directory(options.case_path, model) : options.output;
}

std::unique_ptr<const core::OutputDirectory> take_directory(const fs::path& directory, const RunOptions& options) {
  if (options.resume && !has_checkpoint(directory))
    throw core::FileError(
        fmt::format("{}: no checkpoint to resume from; leave out --resume to begin anew", directory.string()));
  auto taken = std::make_unique<const core::OutputDirectory>(directory);
  // A run stopped while its bed settled has written only its record.
  const bool began = has_checkpoint(directory) || fs::exists(directory / "history.csv");
  if (fs::exists(directory / "run.json") && began && !options.resume && !options.force)
    throw core::CaseError(
        fmt::format("{} contains a run already: --resume goes on with it, --force replaces it, -o DIR writes elsewhere",
                    directory.string()));
  return taken;
}

bool has_checkpoint(const fs::path& directory) {
  const fs::path path = checkpoint_path(directory);
  return fs::exists(path) || fs::exists(core::previous_checkpoint(path));
}

fs::path checkpoint_path(const fs::path& directory) { return directory / "checkpoint.h5"; }

core::Checkpoint read_checkpoint_of(const fs::path& directory, const core::Scene& scene, const std::string& model) {
  core::Checkpoint checkpoint = read_newest_checkpoint(directory);
  const auto hash = checkpoint.texts.find("physics_hash"), text = checkpoint.texts.find("case");
  const auto end = checkpoint.texts.end();
  const bool same = hash != end && hash->second == physics_hash(scene);
  if (!same && (hash == end || text == end || hash->second != physics_hash(without_added(scene, text->second, model))))
    throw core::CaseError(fmt::format(
        "{}: the checkpoint is of another case; only run and output times may change, and forces on particles may be "
        "added (slot Force of polybed list)",
        directory.string()));
  return checkpoint;
}

void add_case(core::Checkpoint& checkpoint, const core::Scene& scene) {
  checkpoint.texts["case"] = core::resolved_case(scene);
  checkpoint.texts["physics_hash"] = physics_hash(scene);
}

}  // namespace polybed::app
