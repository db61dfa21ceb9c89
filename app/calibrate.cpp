// polybed calibrate: becomes the Python package, which starts this program again, on the ranks if there are any, and
// queries it for a case's boxes, their measurements, and the shape of a table.
#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "app/studies.hpp"
#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/numerics/mpi_start.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/directory.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "core/version.hpp"
#include "multiscale/calibrate/box_result.hpp"
#include "multiscale/calibrate/table_shape.hpp"
#include "multiscale/python_module.hpp"
#include "multiscale/scene_rules.hpp"
#include "relevance/fluid_properties.hpp"
#include "tfm/solids_table.hpp"

namespace polybed::app {

namespace {

using Texts = std::vector<std::string>;

/// Particle-steps per second of sheared boxes, sampled at every fourth step, on the development machine.
constexpr double particle_steps_per_second = 1.5e7;

BoxPoint point_of(const std::string& text) {
  BoxPoint p;
  char regime[8] = {};
  int binary = 0, pushed = 0;
  if (std::sscanf(text.c_str(), "%7s %lf %lf %lf %lf %lf %d %d %d", regime, &p.phi, &p.stokes, &p.restitution,
                  &p.friction, &p.share, &binary, &pushed, &p.seed) != 9)
    throw core::CaseError(fmt::format("calibrate: \"{}\" is no box", text));
  p.regime = core::choice_of<core::BoxRegime>(regime);
  p.binary = binary != 0;
  p.pushed = pushed != 0;
  return p;
}

class Service {
 public:
  Service(std::shared_ptr<const core::Ranks> ranks, std::function<void()> show)
      : ranks_(std::move(ranks)), show_(std::move(show)) {}

  /// \param words  the question and its arguments
  std::string answer(const Texts& words) {
    using Answer = core::Json (Service::*)(const Texts&);
    static const std::map<std::string, Answer> answers{{"case", &Service::read_case},   {"take", &Service::take},
                                                       {"boxes", &Service::name_boxes}, {"run", &Service::run},
                                                       {"table", &Service::read},       {"bed", &Service::read_bed},
                                                       {"ratios", &Service::ratios}};
    return core::json_text((this->*answers.at(words.at(0)))(Texts(words.begin() + 1, words.end())));
  }

 private:
  core::Json read_case(const Texts& words) {
    scene_ = read_chosen_case(words.at(0), Texts(words.begin() + 1, words.end()), {});
    const Plan plan = plan_of(scene_);
    const MeanSphere mean = mean_sphere(scene_.species, scene_.bed.volume_share);
    core::Json numbers = core::Json::array();
    for (const tfm::RegimeNumbers& n : plan.regime.numbers)
      numbers.push_back({{"species", n.species},
                         {"shear_times_relaxation", n.shear_times_relaxation},
                         {"stokes_least", n.stokes_least},
                         {"stokes_most", n.stokes_most},
                         {"stokes_of_shear", n.stokes_of_shear},
                         {"voidage", n.voidage},
                         {"shear_rate", n.shear_rate}});
    core::Json json = {{"regime", core::name_of(plan.regime.kind)},
                       {"reason", plan.regime.reason},
                       {"reference", plan.regime.kind == core::BoxRegime::wet ? "viscous" : tfm::effective_reference},
                       {"numbers", numbers},
                       {"axes",
                        {{"phi", plan.axes.phi},
                         {"stokes", plan.axes.stokes},
                         {"e", plan.axes.restitution},
                         {"mu_p", plan.axes.friction},
                         {"x2", plan.axes.share}}},
                       {"binary", plan.binary},
                       {"seeds", scene_.calibrate.seeds}};
    json["size_ratio"] = plan.binary ? scene_.species[1].diameter / scene_.species[0].diameter : 1;
    if (plan.regime.kind == core::BoxRegime::bed)  // |rho_p - rho_f| g D/rho_p
      json["weight_m2_s2"] = std::abs(1 - relevance::fluid_constants(scene_.fluid).density / mean.density) *
                             scene_.column.gravity * mean.diameter;
    json["ranks"] = ranks_ ? ranks_->count() : 1;
    json["git_commit"] = core::git_commit();
    json["case_hash"] = core::case_hash(scene_);
    return json;
  }

  core::Json take(const Texts& words) {
    core::on_first(ranks_.get(), [&] {
      taken_.emplace(words.at(0));
      core::make_folder(std::filesystem::path(words.at(0)) / "boxes");
    });
    return nullptr;
  }

  [[nodiscard]] double expected(const BoxPoint& point) const {
    return particle_steps_of(scene_, point) / particle_steps_per_second;
  }

  core::Json name_boxes(const Texts& words) {
    core::Json boxes = core::Json::array();
    for (const std::string& word : words) {
      const BoxPoint point = point_of(word);
      boxes.push_back(core::Json::array({box_hash(scene_, point), expected(point)}));
    }
    return boxes;
  }

  /// All ranks share a fluidised box. A sheared box runs on one rank; the next one goes to the rank with the least
  /// work.
  core::Json run(const Texts& words) {
    std::vector<double> load(std::size_t(ranks_ ? ranks_->count() : 1), 0.0);
    std::vector<std::int64_t> failed(words.size() / 2, 0);
    const auto here = std::size_t(ranks_ ? ranks_->rank() : 0);
    for (std::size_t n = 0; n < failed.size(); ++n) {
      const BoxPoint point = point_of(words[2 * n + 1]);
      const bool shared = point.regime == core::BoxRegime::bed;
      const auto who = std::size_t(std::min_element(load.begin(), load.end()) - load.begin());
      load[who] += expected(point);
      if (!shared && who != here) continue;
      try {
        const BoxResult result = run_box(scene_, point, shared ? ranks_ : nullptr);
        core::on_first(shared ? ranks_.get() : nullptr, [&] { write_box(words[2 * n], result); });
        if (here == 0) show_();
      } catch (const core::NumericsError& error) {
        core::print(stderr, "{}\n", error.what());
        failed[n] = 1;
      }
    }
    core::add_over_ranks(ranks_.get(), failed);
    core::Json places = core::Json::array();
    for (std::size_t n = 0; n < failed.size(); ++n)
      if (failed[n] != 0) places.push_back(n);
    return places;
  }

  core::Json read(const Texts& words) {
    core::Json json;
    core::on_first(ranks_.get(), [&] {
      const tfm::SolidsTable table = tfm::read_solids_table(words.at(0));
      json = {{"falls", falls_of(table)},
              {"falls_in_shear_up_to", falls_in_shear_up_to(table)},
              {"a", structure_coefficients(table)}};
    });
    return json;
  }

  core::Json read_bed(const Texts& words) {
    core::on_first(ranks_.get(), [&] {
      if (tfm::regime_of_table(words.at(0)) != core::BoxRegime::bed)
        throw core::CaseError(words[0] + ": no table of fluidised boxes, as --bed takes one");
      (void)tfm::read_bed_table(words[0]);
    });
    return nullptr;
  }

  core::Json ratios(const Texts& words) {
    core::Json rows = core::Json::array();
    core::on_first(ranks_.get(), [&] {
      const tfm::SolidsTable table = tfm::read_solids_table(words.at(0));
      for (std::size_t n = 1; n < words.size(); ++n) {
        const BoxPoint p = point_of(words[n]);
        const auto at = [&](double sigma) {
          return tfm::ratios_at(table, {p.restitution, p.friction, p.share, sigma})(p.phi, p.stokes);
        };
        const closures::RatioValues mean = at(0), up = at(1);
        rows.push_back({mean.pressure.pressure, up.pressure.pressure, mean.viscosity.pressure, up.viscosity.pressure});
      }
    });
    return rows;
  }

  std::shared_ptr<const core::Ranks> ranks_;
  std::function<void()> show_;  ///< reports that the first rank has finished a box
  core::Scene scene_;
  std::optional<core::OutputDirectory> taken_;  ///< by the first rank
};

Texts words_of(const std::string& line) {
  Texts words;
  const core::Json question = core::parse_json(line);
  for (const core::Json& word : core::array_of(question)) words.push_back(core::text_of(word));
  return words;
}

/// Answers questions until there are no more: each is a line with a JSON array of texts, each answer a line of JSON.
///   case PATH SETTING...      reads the case: the plan, {"regime", "axes", "seeds", ...}; the first question
///   take DIRECTORY            locks the directory as long as this runs; null
///   boxes POINT...            hash and expected seconds on one core of each, [[hash, s], ...]
///   run FILE POINT ...        runs boxes on the ranks, in this order: null each time the first rank has finished
///                             one of its own, and at the end the indices of failed boxes, [0, 3]
///   table PATH                shape of a table of sheared boxes, {"falls", "falls_in_shear_up_to", "a"}
///   bed PATH                  null for a table of fluidised boxes
///   ratios PATH POINT...      [p, p plus one standard error, mu, mu likewise] of each, as a run reads a table
/// A point is "regime phi stokes restitution friction share binary pushed seed". Collective; the first rank reads and
/// writes. Throws the errors from a question.
void answer_calibration() {
  const std::shared_ptr<const core::Ranks> ranks = core::started_by_launcher() ? core::Ranks::of_program() : nullptr;
  const auto show = [](const std::string& text) {
    core::put(stdout, text + "\n");
    std::fflush(stdout);
  };
  Service service(ranks, [&show] { show("null"); });
  for (std::string line;;) {
    if (core::is_first(ranks.get()) && !std::getline(std::cin, line)) line.clear();
    line = core::said_by(ranks.get(), 0, line);
    if (line.empty()) return;
    const std::string answer = service.answer(words_of(line));
    if (core::is_first(ranks.get())) show(answer);
  }
}

/// Runs one box and writes its file. Collective for a fluidised one.
void run_box_into(const std::string& file, const std::string& case_path, const std::vector<std::string>& overrides,
                  const std::string& point) {
  write_box(file, run_box(read_chosen_case(case_path, overrides, {}), point_of(point)));
}

/// Words for the command's own use: `--serve`, and `--box PARENT FILE CASE POINT SETTING...`.
bool serves(const std::vector<std::string>& words) { return !words.empty() && words[0] == "--serve"; }
bool is_box(const std::vector<std::string>& words) { return words.size() > 4 && words[0] == "--box"; }

On runs_on(const std::vector<std::string>& words) {
  if (is_box(words)) return words[4].starts_with("bed") ? On::all_ranks : On::one_process;
  if (serves(words)) return core::started_by_launcher() ? On::all_ranks : On::one_process;
  return On::study;
}

core::ExitCode run_calibrate(const std::vector<std::string>& words) {
  if (serves(words)) {
    answer_calibration();
    return core::ExitCode::done;
  }
  if (!is_box(words)) become_python("polybed.calibration", words);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a box ends with the command that started it
  if (std::to_string(::getppid()) != words[1]) return core::ExitCode::stopped;
  run_box_into(words[2], words[3], {words.begin() + 5, words.end()}, words[4]);
  return core::ExitCode::done;
}

}  // namespace

void add_calibrate(CLI::App& app, Commands& commands) {
  CLI::App& command = add_handed_over(
      app, "calibrate", "run boxes of particles and make a table of the solids stress for the two-fluid model");
  commands.push_back({&command, [&command] { return run_calibrate(command.remaining()); },
                      [&command] { return runs_on(command.remaining()); }});
}

}  // namespace polybed::app
