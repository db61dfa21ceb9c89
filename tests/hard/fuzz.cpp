#include "hard/fuzz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/numerics/run.hpp"
#include "core/output/files.hpp"
#include "dem/model.hpp"
#include "hard/child.hpp"
#include "hard/grains.hpp"
#include "hard/result_text.hpp"
#include "multiscale/roles.hpp"
#include "tfm/rules.hpp"

namespace polybed::hard {

namespace {

namespace fs = std::filesystem;

/// The continuum under a trial's eyes, to be driven as its command drives it.
class WatchedColumn final : public core::Simulation {
 public:
  WatchedColumn(Trial& trial, Run& run) : trial_(trial), run_(run) {}
  [[nodiscard]] double time() const override { return run_.time(); }
  void step(double stop) override { (void)trial_.step(run_, stop, watch); }
  void show(double t) override { run_.model().show(t); }
  void restart() override { trial_.restart(run_); }

  const Watch watch{.steps = false};

 private:
  Trial& trial_;
  Run& run_;
};

/// Particles likewise.
class WatchedGrains final : public core::Simulation {
 public:
  WatchedGrains(Grains& grains, dem::Model& model) : grains_(grains), model_(model) {}
  [[nodiscard]] double time() const override { return model_.time(); }
  void step(double stop) override {
    constexpr std::int64_t seen_every = 64;
    model_.step(stop);
    if (model_.steps() % seen_every == 0) grains_.see();
  }
  void show(double t) override { model_.show(t); }
  void restart() override { model_.restart(); }

 private:
  Grains& grains_;
  dem::Model& model_;
};

/// Runs to the end of the scene as the commands do, through its output, checkpoint and breakpoint times. Throws
/// NumericsError where an observer is shown another time than the one that was due.
/// \returns false if `over` ended it
bool run_as_commands_do(core::Simulation& simulation, const core::Scene& scene, std::vector<double> breakpoints,
                        const std::function<bool()>& over) {
  const auto act = [&](double t) {
    if (!(t <= simulation.time())) throw std::logic_error(fmt::format("output of {} s at {} s", t, simulation.time()));
  };
  try {
    core::run(
        simulation, {scene.run.until, *scene.output.checkpoint_every, std::move(breakpoints)},
        {{"history", *scene.output.history_every, act}, {"fields", *scene.output.every, act}}, true, [](double) {},
        [&] { return !over(); });
  } catch (const core::Stopped&) {
    return false;
  }
  return true;
}

/// A run as particles, if that is what the case is for, or else as a continuum.
void run_scene(Trial& trial, const core::Scene& scene, double cpu) {
  const double begin = core::cpu_seconds();
  if (!core::problems_of(tfm::model_rules(), scene).empty() || scene.effects.contains("contact")) {
    core::Timers timers;
    dem::Model model(scene, timers);
    Grains grains(trial, model, {.cpu = cpu});
    WatchedGrains watched(grains, model);
    trial.report("ends", run_as_commands_do(watched, scene, {}, [&] { return grains.over(begin); }) ? 1 : 0);
    grains.see();
    trial.keep_work(std::uint64_t(model.steps()), model.limits().dt);
    return;
  }
  const auto run = trial.begin(scene);
  WatchedColumn watched(trial, *run);
  const auto over = [&] { return core::cpu_seconds() - begin > cpu || trial.has_failed(); };
  trial.report("ends", run_as_commands_do(watched, scene, run->model().breakpoints(), over) ? 1 : 0);
  trial.see_end(*run, watched.watch);
}

/// Bisection of one parameter: the value nearest to its standard at which the draw still fails, to 5 %.
void shrink_one(Draw& draw, std::size_t n, const std::function<bool(const Draw&)>& fails) {
  Parameter& p = draw.parameters[n];
  const auto holds = [&](double value) {
    const double before = p.value;
    p.value = value;
    if (fails(draw)) return true;
    p.value = before;
    return false;
  };
  if (p.value == p.standard || holds(p.standard)) return;
  if (p.value <= 0 || p.standard <= 0) return;  // 0 has no logarithm: it stands or it falls
  double good = p.standard;
  const double nearest = p.whole ? 0.0 : std::log(1.05);
  while (std::abs(std::log(p.value / good)) > nearest) {
    double middle = std::sqrt(p.value * good);
    if (p.whole) middle = std::round(middle);
    if (p.whole && (middle == p.value || middle == good)) return;
    if (!holds(middle)) good = middle;
  }
}

double two_digits(double value) { return std::stod(fmt::format("{:.1e}", value)); }

void round_all(Draw& draw, const std::function<bool(const Draw&)>& fails) {
  for (Parameter& p : draw.parameters) {
    const double before = p.value;
    p.value = p.whole ? before : two_digits(before);
    if (p.value != before && !fails(draw)) p.value = before;
  }
}

std::string cause_page(const Found& found, std::uint64_t seed) {
  std::string text = fmt::format(
      "# Found by `polybed stability --fuzz`, seed {}, draw {}\n\nOutcome of this case then: {}; {}\n\n{}\n\nWhat "
      "differs "
      "from the standard:\n\n",
      seed, found.number, name_of(found.result.outcome), found.result.broken, found.result.cause);
  for (const Parameter& p : found.draw.parameters)
    if (p.value != p.standard) text += fmt::format("- {}: {:.4g}, standard {:.4g}\n", p.name, p.value, p.standard);
  return text;
}

}  // namespace

Result result_of_case(const std::string& text, const std::string& name, double cpu) {
  core::Scene scene;
  try {
    scene = core::parse_case(text, name, {}, multiscale::all_roles(), multiscale::size_classes);
  } catch (const core::CaseError& error) {
    Result refused;
    refused.outcome = Outcome::refused;
    refused.cause = error.what();
    return refused;
  }
  Trial trial({"case", "", ""});
  return trial.judge([&](Trial& t) { run_scene(t, scene, cpu); });
}

std::vector<Result> results_of(const std::vector<std::string>& texts, int jobs, double cpu,
                               const std::function<void(std::size_t, const Result&)>& seen) {
  std::vector<Result> results(texts.size());
  constexpr double most_memory = 4e9;  // bytes: a few hundred particles or cells need less than a thousandth
  // What begins before the run, a packing for one, may take twice as long; waiting for a core much longer.
  in_children(
      texts.size(), {jobs, 300 * (cpu + 1), 3 * (cpu + 1), most_memory},
      [&](std::size_t n) { return text_of(result_of_case(texts[n], "case", cpu)); },
      [&](std::size_t n, const ChildEnd& end) {
        results[n] = result_of(end);
        if (seen) seen(n, results[n]);
      });
  return results;
}

Draw shrunk(Draw draw, const std::function<bool(const Draw&)>& fails) {
  constexpr int most_rounds = 5;  // each ends with a smaller draw, or there is no next one
  for (int round = 0; round < most_rounds; ++round) {
    const Draw before = draw;
    for (std::size_t n = 0; n < draw.parameters.size(); ++n) shrink_one(draw, n, fails);
    if (draw == before) break;
  }
  round_all(draw, fails);
  return draw;
}

std::string kind_of(const Result& result) {
  std::string kind = result.broken;
  const std::string line = result.cause.substr(0, result.cause.find('\n'));
  if (!line.empty()) kind += ": ";
  bool in_number = false;
  for (const char c : line) {
    const bool digit = c >= '0' && c <= '9';
    if (digit && !in_number) kind += '#';
    in_number = digit || (in_number && (c == '.' || c == 'e' || c == '-' || c == '+'));
    if (!in_number) kind += c;
  }
  return kind;
}

namespace {

/// What expected.toml of a kept case says of a key; empty if it does not.
std::string expected(const fs::path& folder, const std::string& key) {
  std::ifstream file(folder / "expected.toml");
  for (std::string line; std::getline(file, line);) {
    const std::size_t begin = line.find('"'), end = line.find('"', begin + 1);
    if (line.starts_with(key + " =") && end != std::string::npos) return line.substr(begin + 1, end - begin - 1);
  }
  return "";
}

}  // namespace

fs::path keep(const Found& found, std::uint64_t seed, const fs::path& directory) {
  fs::path folder;
  for (int n = 1; folder.empty() || fs::exists(folder); ++n) folder = directory / fmt::format("{:03}", n);
  core::make_directories(folder);
  core::write_atomically(folder / "case.toml", case_text(found.draw));
  core::write_atomically(
      folder / "expected.toml",
      fmt::format("outcome = \"PASS\"  # or REFUSED, if that is the right answer\ntitle = \"found by seed {}\"\n",
                  seed));
  core::write_atomically(folder / "README.md", cause_page(found, seed));
  return folder;
}

std::vector<HardCase> kept_cases(const fs::path& directory) {
  std::set<fs::path> folders;
  if (fs::is_directory(directory))
    for (const auto& entry : fs::directory_iterator(directory))
      if (fs::exists(entry.path() / "case.toml")) folders.insert(entry.path());
  std::vector<HardCase> cases;
  for (const fs::path& folder : folders) {
    const auto work = [folder](Trial& trial) {
      constexpr double longest = 8;  // s of computing
      const core::Scene scene =
          core::read_case(folder / "case.toml", {}, multiscale::all_roles(), multiscale::size_classes);
      run_scene(trial, scene, longest);
    };
    cases.push_back({"F" + folder.filename().string(), expected(folder, "title"), {}, {{"case", "", ""}}, work});
  }
  return cases;
}

std::string kept_outcome(const fs::path& directory, const std::string& id) {
  return expected(directory / id.substr(1), "outcome");
}

}  // namespace polybed::hard
