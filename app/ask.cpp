// polybed ask: answers the questions of the Python package, JSON in and JSON out, on the ranks if there are any.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/ask.hpp"
#include "app/commands.hpp"
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
#include "multiscale/scene_rules.hpp"
#include "relevance/fluid_properties.hpp"
#include "tfm/solids_table.hpp"

namespace polybed::app {

namespace {

/// Particle-steps per second of sheared boxes, looked at every fourth step, on the development machine.
constexpr double particle_steps_per_second = 1.5e7;

BoxPoint point_of(const core::Json& asked) {
  const auto number = [&](const char* name) { return core::number_of(core::member_of(asked, name)); };
  const auto is = [&](const char* name) { return core::member_of(asked, name) == true; };
  return {core::choice_of<core::BoxRegime>(core::text_of(core::member_of(asked, "regime"))),
          number("phi"),
          number("stokes"),
          number("restitution"),
          number("friction"),
          number("share"),
          is("binary"),
          is("pushed"),
          int(core::count_of(core::member_of(asked, "seed")))};
}

std::vector<BoxPoint> points_of(const core::Json& question) {
  std::vector<BoxPoint> points;
  for (const core::Json& point : core::array_of(core::member_of(question, "points"))) points.push_back(point_of(point));
  return points;
}

std::string text_in(const core::Json& question, const char* name) {
  return core::text_of(core::member_of(question, name));
}

std::vector<std::string> texts_in(const core::Json& question, const char* name) {
  std::vector<std::string> texts;
  for (const core::Json& text : core::array_of(core::member_of(question, name))) texts.push_back(core::text_of(text));
  return texts;
}

core::Json shape_of_table(const core::Json& question) {
  const tfm::SolidsTable table = tfm::read_solids_table(text_in(question, "table"));
  return {{"falls", falls_of(table)},
          {"falls_in_shear_up_to", falls_in_shear_up_to(table)},
          {"a", structure_coefficients(table)}};
}

core::Json read_bed(const core::Json& question) {
  const std::string table = text_in(question, "table");
  if (tfm::regime_of_table(table) != core::BoxRegime::bed)
    throw core::CaseError(table + ": no table of fluidised boxes, as --bed takes one");
  (void)tfm::read_bed_table(table);
  return nullptr;
}

core::Json mark(const core::Json& question) {
  core::mark_directory(text_in(question, "folder"));
  return nullptr;
}

core::Json ratios_of_table(const core::Json& question) {
  core::Json rows = core::Json::array();
  const tfm::SolidsTable table = tfm::read_solids_table(text_in(question, "table"));
  for (const BoxPoint& p : points_of(question)) {
    const auto at = [&](double sigma) {
      return tfm::ratios_at(table, {p.restitution, p.friction, p.share, sigma})(p.phi, p.stokes);
    };
    const closures::RatioValues mean = at(0), up = at(1);
    rows.push_back({mean.pressure.pressure, up.pressure.pressure, mean.viscosity.pressure, up.viscosity.pressure});
  }
  return rows;
}

class Service {
 public:
  Service(std::shared_ptr<const core::Ranks> ranks, std::function<void()> show)
      : ranks_(std::move(ranks)), show_(std::move(show)) {}

  core::Json answer(const core::Json& question) {
    static const std::map<std::string, core::Json (Service::*)(const core::Json&)> by_all{
        {"case", &Service::read_case},
        {"boxes", &Service::name_boxes},
        {"run", &Service::run},
        {"take", &Service::take}};
    static const std::map<std::string, core::Json (*)(const core::Json&)> by_first{
        {"table", shape_of_table},   {"bed", read_bed},        {"mark", mark},
        {"ratios", ratios_of_table}, {"drag", drag_of_points}, {"means", means_of_series}};
    const std::string asked = text_in(question, "ask");
    if (const auto found = by_all.find(asked); found != by_all.end()) return (this->*found->second)(question);
    core::Json answer;
    core::on_first(ranks_.get(), [&] { answer = by_first.at(asked)(question); });
    return answer;
  }

 private:
  core::Json read_case(const core::Json& question) {
    scene_ = read_chosen_case(text_in(question, "case"), texts_in(question, "settings"), {});
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

  [[nodiscard]] double expected(const BoxPoint& point) const {
    return particle_steps_of(scene_, point) / particle_steps_per_second;
  }

  core::Json name_boxes(const core::Json& question) {
    core::Json boxes = core::Json::array();
    for (const BoxPoint& point : points_of(question))
      boxes.push_back(core::Json::array({box_hash(scene_, point), expected(point)}));
    return boxes;
  }

  /// A fluidised box is shared by all ranks; of sheared boxes, which one rank runs, the next one goes to the rank that
  /// has least to do.
  core::Json run(const core::Json& question) {
    const std::vector<std::string> files = texts_in(question, "files");
    const std::vector<BoxPoint> points = points_of(question);
    std::vector<double> load(std::size_t(ranks_ ? ranks_->count() : 1), 0.0);
    std::vector<std::int64_t> failed(points.size(), 0);
    const auto here = std::size_t(ranks_ ? ranks_->rank() : 0);
    for (std::size_t n = 0; n < failed.size(); ++n) {
      const BoxPoint& point = points[n];
      const bool shared = point.regime == core::BoxRegime::bed;
      const auto who = std::size_t(std::min_element(load.begin(), load.end()) - load.begin());
      load[who] += expected(point);
      if (!shared && who != here) continue;
      try {
        const BoxResult result = run_box(scene_, point, shared ? ranks_ : nullptr);
        core::on_first(shared ? ranks_.get() : nullptr, [&] { write_box(files.at(n), result); });
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

  core::Json take(const core::Json& question) {
    core::on_first(ranks_.get(),
                   [&] { taken_.push_back(std::make_unique<core::OutputDirectory>(text_in(question, "folder"))); });
    return nullptr;
  }

  std::shared_ptr<const core::Ranks> ranks_;
  std::function<void()> show_;  ///< that the first rank has finished a box
  core::Scene scene_;
  std::vector<std::unique_ptr<core::OutputDirectory>> taken_;
};

/// Answers questions until there are no more: each is a line with a JSON object, each answer a line of JSON. `ask`
/// names the question, the other members say what it is about:
///   case {case, settings}          reads the case: the plan of its boxes, {"regime", "axes", "seeds", ...}
///   boxes {points}                 of each box its hash and the seconds expected on one core, [[hash, s], ...]
///   run {points, files}            runs boxes on the ranks, in this order: null each time the first rank has finished
///                                  one of its own, and at the end the places of those that failed, [0, 3]
///   table {table}                  how a table of sheared boxes runs, {"falls", "falls_in_shear_up_to", "a"}
///   bed {table}                    null for a table of fluidised boxes
///   ratios {table, points}         of each [p, p one standard error up, mu, mu likewise] that a run reads from it
///   drag {law, partition, points}  of each [eps, Re, x1, D1, ...] the answers of polybed drag by name
///   means {series, ratios}         as polybed measure --series
///   take {folder}                  null; the folder is made, marked and locked until there are no more questions
///   mark {folder}                  null; the folder is made and marked
/// A box is {"regime", "phi", "stokes", "restitution", "friction", "share", "binary", "pushed", "seed"}, of the case
/// read before. Collective; the first rank reads and writes. Throws the error of a question.
void answer_questions() {
  const std::shared_ptr<const core::Ranks> ranks = core::started_by_launcher() ? core::Ranks::of_program() : nullptr;
  const auto show = [](const core::Json& answer) {
    core::put(stdout, core::json_text(answer) + "\n");
    std::fflush(stdout);
  };
  Service service(ranks, [&show] { show(nullptr); });
  for (std::string line;;) {
    if (core::is_first(ranks.get()) && !std::getline(std::cin, line)) line.clear();
    line = core::said_by(ranks.get(), 0, line);
    if (line.empty()) return;
    const core::Json answer = service.answer(core::parse_json(line));
    if (core::is_first(ranks.get())) show(answer);
  }
}

}  // namespace

void add_ask(CLI::App& app, Commands& commands) {
  CLI::App& command = *app.add_subcommand("ask", "answers the questions of the Python package, a JSON object per line");
  command.group("");  // internal: not in the help
  commands.push_back({&command, doing(answer_questions),
                      [] { return core::started_by_launcher() ? On::all_ranks : On::one_process; }});
}

}  // namespace polybed::app
