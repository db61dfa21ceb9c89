// polybed resolve: drag data from resolved flow through random boxes of the case's spheres.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "app/run_directory.hpp"
#include "core/interrupt.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/directory.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/output/rows.hpp"
#include "core/print.hpp"
#include "core/progress.hpp"
#include "multiscale/resolve/rows.hpp"
#include "multiscale/scene_rules.hpp"

namespace polybed::app {

namespace {

/// Options for drag data from resolved flow.
struct ResolveOptions : CaseOptions {
  std::filesystem::path output;  ///< empty: runs/<case name>-resolve
  bool resume = false, force = false, quiet = false, estimate = false;
};

namespace fs = std::filesystem;

/// For a box that is not steady yet.
fs::path file_of_box(const fs::path& directory, const std::string& name) { return directory / ("box-" + name + ".h5"); }

void remove_kept_boxes(const fs::path& directory) {
  std::error_code none;  // a file that stays does no harm
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, none))
    if (entry.path().filename().string().starts_with("box-")) fs::remove(entry.path(), none);
}

/// Chooses contact laws that the case leaves open only for free spheres.
core::Scene read_boxes(const ResolveOptions& options) {
  const core::Scene scene = read_case(options.case_path, options.overrides, {});
  if (scene.resolve.voidage.empty())
    throw core::CaseError(options.case_path.string() + ": resolve needs resolve.voidage, e.g. [0.5, 0.7]");
  if (scene.bed.volume_share.size() != scene.species.size())
    throw core::CaseError(options.case_path.string() + ": resolve needs bed.volume_share, one for each species");
  return scene.resolve.motion == core::SphereMotion::free ? read_chosen_case(options.case_path, options.overrides, {})
                                                          : scene;
}

/// \param free  the Reynolds number is a result
std::string point_text(double voidage, double reynolds, bool free) {
  return fmt::format("eps {:g}", voidage) + (free ? "" : fmt::format(", Re {:g}", reynolds));
}

void tell_notes(const core::Scene& scene) {
  for (const std::string& note : packing_notes(scene)) core::print(stderr, "note: {}\n", note);
}

/// Rows of the points, from the speed of the first one's coarsest box on one core.
void estimate_resolve(const ResolveOptions& options) {
  const core::Scene scene = read_boxes(options);
  tell_notes(scene);
  const core::Resolve& plan = scene.resolve;
  const ResolvePoint first{plan.voidage[0], plan.reynolds[0], 0, plan.grids - 1};
  const bool free = plan.motion == core::SphereMotion::free;
  const double rate = measured_rate(scene, first, sphere_packing(scene, first.voidage, scene.bed.seed));
  core::Json points = core::Json::array();
  double all = 0, most = 0;
  for (const double voidage : plan.voidage)
    for (const double reynolds : plan.reynolds) {
      double seconds = 0, bytes = 0;
      for (int grid = 0; grid < plan.grids; ++grid)
        for (const std::vector<int>& past : passed(scene, reynolds)) {
          const BoxNeed need = box_need(scene, {voidage, reynolds, 0, grid, past});
          seconds += plan.packings * need.sites * need.steps / rate;
          bytes = std::max(bytes, need.bytes);
        }
      points.push_back({{"eps", voidage}, {"time_s", seconds}, {"memory_bytes", bytes}});
      if (!free) points.back()["Re"] = reynolds;
      if (!options.json)
        core::print("{}: {}, {:.3g} MB\n", point_text(voidage, reynolds, free), core::duration_text(seconds),
                    1e-6 * bytes);
      all += seconds;
      most = std::max(most, bytes);
    }
  if (options.json)
    return core::print(
        "{}\n",
        core::json_text({{"points", points}, {"time_s", all}, {"memory_bytes", most}, {"sites_per_second", rate}}));
  core::print("all: {} on one core at {:.0f} million sites a second, within a factor of 2 if the flow is steady\n",
              core::duration_text(all), 1e-6 * rate);
}

class ResolveRun {
 public:
  explicit ResolveRun(const ResolveOptions& options)
      : options_(options),
        ranks_(core::Ranks::of_program()),
        first_(core::is_first(ranks_.get())),
        rank_(ranks_ ? ranks_->rank() : 0),
        scene_(read_boxes(options)) {
    options_.quiet = options_.quiet || !first_;
    directory_ = options.output.empty() ? default_run_directory(options.case_path, "resolve") : options.output;
    core::on_first(ranks_.get(), [&] { take_directory(); });
  }

  /// Boxes are independent: each rank runs its own, and all receive the results at the end.
  void run() {
    if (!options_.quiet) tell_notes(scene_);
    if (first_ && !options_.json) core::print("{}\n", row_header(scene_));
    table_ = row_header(scene_) + "\n";
    share_boxes();
    core::on_all(ranks_.get(), [&] {
      for (const Box& box : boxes_) {
        if (box.rank == rank_) run_box(box);
        if (!ranks_) write_rows();
      }
    });
    for (const Box& box : boxes_) {
      std::string& text = finished_[box.name];
      text = core::said_by(ranks_.get(), box.rank, text);
    }
    write_rows();
    if (!options_.quiet) core::print(stderr, "{}\n", interval_text(scene_.resolve.packings));
    if (first_ && options_.json)
      core::print("{}\n", core::json_text({{"rows", (directory_ / "rows.csv").string()}, {"table", table_}}));
  }

 private:
  /// Reads the boxes finished by an earlier run; new ones are appended.
  void take_directory() {
    lock_.emplace(directory_);
    const fs::path path = directory_ / "boxes.csv";
    const bool there = fs::exists(path);
    if (there && !options_.resume && !options_.force)
      throw core::CaseError(
          fmt::format("{} contains boxes already: --resume goes on with them, --force replaces them, -o DIR writes "
                      "elsewhere",
                      directory_.string()));
    if (options_.resume && !there)
      throw core::FileError(
          fmt::format("{}: no boxes to resume from; leave out --resume to begin anew", directory_.string()));
    if (!options_.resume) remove_kept_boxes(directory_);
    std::string kept = fmt::format("box,cells,change,imbalance,steps,sites,seconds, then n{} of each species, check\n",
                                   free_ ? ", f, u, v and w, then its pairs" : " and f");
    if (options_.resume) read_finished(path, kept);
    core::write_atomically(path, kept, core::Flush::content);
  }

  /// Only complete rows with a valid check count: a full disk can cut the last number of a row.
  void read_finished(const fs::path& path, std::string& kept) {
    const std::string text = core::read_text(path);
    std::size_t lost = text.ends_with('\n') || text.empty() ? 0 : 1;
    const auto lines = core::whole_lines(text);
    for (std::size_t n = 1; n < lines.size(); ++n) {
      const std::string row = core::without_check(lines[n]).value_or("");
      const std::size_t name = row.find(',');
      if (name == std::string::npos || box_of_text(row.substr(name + 1), scene_).net.empty()) {
        ++lost;
        continue;
      }
      finished_[row.substr(0, name)] = row.substr(name + 1);
      kept += std::string(lines[n]) + "\n";
    }
    if (lost > 0)
      core::print(stderr, "{}: {} row{} cut short, damaged or without a check: not used\n", path.string(), lost,
                  lost == 1 ? " is" : "s are");
  }

  struct Box {
    ResolvePoint point;
    std::string name;
    int rank = 0;
  };

  /// Distributes all boxes in the order of the rows, the largest first to the rank with the least work.
  void share_boxes() {
    const core::Resolve& plan = scene_.resolve;
    for (const double voidage : plan.voidage)
      for (const double reynolds : plan.reynolds)
        for (int packing = 0; packing < plan.packings; ++packing)
          for (int grid = 0; grid < plan.grids; ++grid)
            for (const std::vector<int>& past : passed(scene_, reynolds)) {
              const ResolvePoint point{voidage, reynolds, packing, grid, past};
              boxes_.push_back({point, box_name(scene_, point)});
              std::string& text = finished_[boxes_.back().name];
              text = core::said_by(ranks_.get(), 0, text);
            }
    if (!ranks_) return;
    std::vector<std::pair<double, Box*>> left;
    for (Box& box : boxes_)
      if (finished_[box.name].empty()) {
        const BoxNeed need = box_need(scene_, box.point);
        left.emplace_back(need.sites * need.steps, &box);
      }
    std::stable_sort(left.begin(), left.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<double> load(std::size_t(ranks_->count()), 0.0);
    for (const auto& [work, box] : left) {
      const auto least = std::min_element(load.begin(), load.end());
      box->rank = int(least - load.begin());
      *least += work;
    }
  }

  void run_box(const Box& box) {
    std::string& text = finished_[box.name];
    if (!text.empty()) return;
    const ResolvePoint& point = box.point;
    if (spheres_of_ != std::pair(point.voidage, point.packing)) {
      spheres_ = sphere_packing(scene_, point.voidage, scene_.bed.seed + (std::uint64_t(point.packing) << 32));
      spheres_of_ = {point.voidage, point.packing};
    }
    const KeptBox kept{file_of_box(directory_, box.name), box.name, scene_.resolve.checkpoint_every};
    const BoxDrag drag = box_drag(
        scene_, point, spheres_, [&](double steps, double change) { return say(point, steps, change); }, &kept);
    text = box_text(drag);
    const std::string line = core::with_check(box.name + "," + text) + "\n";
    core::append_to_file(directory_ / "boxes.csv", std::as_bytes(std::span(line)));
    report(point, drag);
  }

  /// Writes rows whose boxes are finished, after those already written.
  void write_rows() {
    while (in_rows_ < boxes_.size()) {
      const Box* const begin = boxes_.data() + in_rows_;
      const std::size_t parts = passed(scene_, begin->point.reynolds).size();
      const std::size_t of_packing = std::size_t(scene_.resolve.grids) * parts;
      const std::size_t of_row = std::size_t(scene_.resolve.packings) * of_packing;
      RowBoxes drags(of_row / of_packing, {of_packing / parts, std::vector<BoxDrag>()});
      for (std::size_t n = 0; n < of_row; ++n) {
        const std::string& text = finished_[begin[n].name];
        if (text.empty()) return;
        drags[n / of_packing][n % of_packing / parts].push_back(box_of_text(text, scene_));
      }
      const std::string row = row_text(scene_, begin->point.voidage, begin->point.reynolds, drags);
      table_ += row + "\n";
      if (free_) pairs_ += pair_text(scene_, begin->point.voidage, drags);
      in_rows_ += of_row;
      if (!first_) continue;
      core::write_atomically(directory_ / "rows.csv", table_);
      if (free_) core::write_atomically(directory_ / "pairs.csv", pairs_);
      if (!options_.json) core::print("{}\n", row);
    }
  }

  /// Prints at most every few seconds.
  bool say(const ResolvePoint& point, double steps, double change) {
    const auto now = std::chrono::steady_clock::now();
    if (!options_.quiet && now - said_ > std::chrono::seconds(5)) {
      said_ = now;
      const std::int64_t all = plan_of(scene_, point).steps;
      core::print(stderr, "{}: {:.0f} steps{}\n", place_of(point), steps,
                  all > 0 ? fmt::format(" of {}", all) : fmt::format(", drag changes by {:.2g}", change));
    }
    return !interrupt_.wanted();
  }

  void report(const ResolvePoint& point, const BoxDrag& box) {
    if (options_.quiet) return;
    ++done_;
    seconds_ += box.seconds;
    core::print(stderr, "{}: {:.0f} steps, {:.1f} million sites a second; {:.0f} boxes in {}, {} in all\n",
                place_of(point), box.steps, box.sites * box.steps / box.seconds / 1e6, done_,
                core::duration_text(seconds_), boxes_.size());
    if (box.change > 1e-4)
      core::print(stderr, "warning: the drag of this box still changes by {:.2g}: its flow is unsteady\n", box.change);
  }

  [[nodiscard]] std::string past_text(const std::vector<int>& past) const {
    std::string text;
    for (const int j : past)
      text += fmt::format("{} '{}'", text.empty() ? ", past" : " and", scene_.species[std::size_t(j)].name);
    return text;
  }

  [[nodiscard]] std::string place_of(const ResolvePoint& point) const {
    return fmt::format("{}, packing {} of {}, {:.3g} cells per diameter",
                       point_text(point.voidage, point.reynolds, free_), point.packing + 1, scene_.resolve.packings,
                       cells_of(scene_.resolve, point.grid)) +
           past_text(point.past);
  }

  core::Interrupt interrupt_;
  ResolveOptions options_;
  std::shared_ptr<const core::Ranks> ranks_;
  bool first_;
  int rank_;
  core::Scene scene_;
  bool free_ = scene_.resolve.motion == core::SphereMotion::free;
  fs::path directory_;
  std::optional<core::OutputDirectory> lock_;
  std::vector<Box> boxes_;
  std::map<std::string, std::string> finished_;  ///< text of each box; empty for an unfinished one
  SpherePacking spheres_;
  std::pair<double, int> spheres_of_{0, -1};  ///< voidage and packing
  std::size_t in_rows_ = 0;                   ///< boxes whose rows are written
  std::string table_, pairs_ = pair_header() + "\n";
  std::chrono::steady_clock::time_point said_;  ///< initially long ago, so that the first line comes at once
  double done_ = 0, seconds_ = 0;
};

void run_resolve(const ResolveOptions& options) {
  options.estimate ? estimate_resolve(options) : ResolveRun(options).run();
}

}  // namespace

void add_resolve(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<ResolveOptions>();
  CLI::App& command =
      *app.add_subcommand("resolve", "drag data from resolved flow through random boxes of the case's spheres");
  take_case(command, *options);
  command.add_option("-o,--output", options->output, "folder; default runs/<case name>-resolve");
  command.add_flag("--resume", options->resume, "keep the boxes that are finished, and go on with the one that is not");
  command.add_flag("--force", options->force, "replace them");
  command.add_flag("--quiet", options->quiet, "no line for each box");
  command.add_flag("--estimate", options->estimate, "time and memory of each point, and nothing is run");
  commands.push_back({&command, doing([options] { run_resolve(*options); }), [] { return On::all_ranks; }});
}

}  // namespace polybed::app
