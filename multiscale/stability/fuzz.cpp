#include "multiscale/stability/fuzz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "core/case_file.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "dem/model.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/stability/child.hpp"
#include "multiscale/stability/grains.hpp"
#include "multiscale/stability/result_text.hpp"
#include "tfm/particle_scene.hpp"

namespace polybed::stability {

namespace {

namespace fs = std::filesystem;

/// A run as particles, if that is what the case is for, or else as a continuum.
void run_scene(Trial& trial, const core::Scene& scene, double cpu) {
  if (!tfm::only_for_particles(scene).empty() || scene.effects.contains("contact")) {
    core::Timers timers;
    dem::Model model(scene, timers);
    Grains grains(trial, model, {.cpu = cpu});
    trial.report("ends", grains.until(scene.run.until) ? 1 : 0);
    return;
  }
  const auto run = trial.begin(scene);
  trial.advance(*run, scene.run.until, {.steps = false, .cpu = cpu});
  trial.report("ends", run->time() >= scene.run.until ? 1 : 0);
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

fs::path keep(const Found& found, std::uint64_t seed, const fs::path& directory) {
  fs::path folder;
  for (int n = 1; folder.empty() || fs::exists(folder); ++n) folder = directory / fmt::format("{:03}", n);
  core::make_directories(folder);
  core::write_atomically(folder / "case.toml", case_text(found.draw));
  core::write_atomically(folder / "expected.toml",
                         "outcome = \"PASS\"  # once it is mended; or REFUSED, if refusing it is right\n");
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
    cases.push_back({"F" + folder.filename().string(), "found by drawing", {}, {{"case", "", ""}}, work});
  }
  return cases;
}

std::string kept_outcome(const fs::path& directory, const std::string& id) {
  std::ifstream file(directory / id.substr(1) / "expected.toml");
  std::string text;
  std::getline(file, text);
  const std::size_t begin = text.find('"'), end = text.find('"', begin + 1);
  return end == std::string::npos ? "" : text.substr(begin + 1, end - begin - 1);
}

}  // namespace polybed::stability
