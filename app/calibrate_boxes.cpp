#include "app/calibrate_boxes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/output/files.hpp"
#include "core/print.hpp"
#include "core/progress.hpp"
#include "multiscale/calibrate/pool.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;

/// Particle-steps per second of sheared boxes, looked at every fourth step, on the development machine.
constexpr double particle_steps_per_second = 1.5e7;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

fs::path file_of(const fs::path& directory, const core::Scene& scene, const BoxPoint& point) {
  return directory / "boxes" / (box_hash(scene, point) + ".json");
}

Boxes::Boxes(const CalibrateOptions& options, const core::Scene& scene, fs::path directory,
             std::vector<BoxPoint> points, std::shared_ptr<const core::Ranks> ranks)
    : options_(options),
      scene_(scene),
      directory_(std::move(directory)),
      points_(std::move(points)),
      ranks_(std::move(ranks)) {
  std::vector<double> there;
  for (const BoxPoint& p : points_) {
    expected_.push_back(particle_steps_of(scene_, p) / particle_steps_per_second);
    there.push_back(read_box(file_of(directory_, scene_, p), box_hash(scene_, p)) ? 1 : 0);
  }
  core::take_from_first(ranks_.get(), there);
  done_.assign(there.begin(), there.end());
}

double Boxes::expected_left() const {
  double left = 0;
  for (std::size_t n = 0; n < points_.size(); ++n) left += done_[n] ? 0 : expected_[n];
  return left;
}

std::size_t Boxes::left() const { return std::size_t(std::count(done_.begin(), done_.end(), false)); }

std::vector<BoxResult> Boxes::run() {
  core::on_first(ranks_.get(), [&] { core::make_folder(directory_ / "boxes"); });
  std::vector<std::size_t> todo;
  for (std::size_t n = 0; n < points_.size(); ++n)
    if (!done_[n]) todo.push_back(n);
  const std::vector<std::size_t> failed = options_.launched ? run_here(std::move(todo)) : run_as_processes(todo);
  if (!failed.empty())
    throw core::NumericsError(fmt::format("{} boxes failed, the first at phi = {:g}; finished ones are kept",
                                          failed.size(), points_[failed.front()].phi));
  return results();
}

/// Boxes that other ranks have finished meanwhile are known by their files.
/// \param begin  s  \param all  expected when it began
void Boxes::tell(double begin, double all) {
  if (options_.quiet) return;
  for (std::size_t n = 0; n < points_.size(); ++n)
    done_[n] = done_[n] || (ranks_ && read_box(file_of(directory_, scene_, points_[n]), box_hash(scene_, points_[n])));
  const double passed = seconds() - begin, left_now = expected_left();
  core::print(stderr, "{} of {} boxes; about {} left\n", points_.size() - left(), points_.size(),
              core::duration_text(passed * left_now / std::max(all - left_now, 1e-9)));
}

/// This program again for each box, several at once. Returns those that failed.
std::vector<std::size_t> Boxes::run_as_processes(const std::vector<std::size_t>& todo) {
  std::vector<Job> jobs;
  for (const std::size_t n : todo) jobs.push_back({arguments(points_[n]), expected_[n]});
  const double begin = seconds(), all = expected_left();
  const core::Interrupt interrupt;
  std::vector<std::size_t> failed = run_jobs(
      jobs, options_.jobs,
      [&](std::size_t job) {
        done_[todo[job]] = true;
        tell(begin, all);
      },
      [&] { return !interrupt.wanted(); });
  for (std::size_t& n : failed) n = todo[n];
  return failed;
}

/// By the ranks: a fluidised box is shared by all of them; of sheared boxes, which one rank runs, the longest that is
/// left goes to the rank that has least to do. Returns those that failed.
std::vector<std::size_t> Boxes::run_here(std::vector<std::size_t> todo) {
  std::stable_sort(todo.begin(), todo.end(), [&](std::size_t a, std::size_t b) { return expected_[a] > expected_[b]; });
  std::vector<double> load(std::size_t(at_once()), 0.0);
  std::vector<std::int64_t> failed(points_.size(), 0);
  const auto here = std::size_t(ranks_ ? ranks_->rank() : 0);
  const double begin = seconds(), all = expected_left();
  for (const std::size_t n : todo) {
    const bool shared = points_[n].regime == "bed";
    const auto who = std::size_t(std::min_element(load.begin(), load.end()) - load.begin());
    load[who] += expected_[n];
    if (!shared && who != here) continue;
    try {
      run_one(n, shared ? ranks_ : nullptr);
      done_[n] = true;
      if (here == 0) tell(begin, all);
    } catch (const core::NumericsError& error) {
      core::print(stderr, "{}\n", error.what());
      failed[n] = 1;
    }
  }
  core::add_over_ranks(ranks_.get(), failed);
  if (here == 0 && left() > 0) tell(begin, all);  // of the boxes that others finished after this rank's last
  std::vector<std::size_t> places;
  for (std::size_t n = 0; n < failed.size(); ++n)
    if (failed[n] != 0) places.push_back(n);
  return places;
}

void Boxes::run_one(std::size_t place, const std::shared_ptr<const core::Ranks>& ranks) {
  const BoxResult result = run_box(scene_, points_[place], ranks);
  core::on_first(ranks.get(), [&] { write_box(file_of(directory_, scene_, points_[place]), result); });
}

std::vector<std::string> Boxes::arguments(const BoxPoint& p) const {
  std::vector<std::string> a{"calibrate",
                             options_.case_path.string(),
                             "-o",
                             directory_.string(),
                             "--box",
                             fmt::format("{} {} {} {} {} {} {} {} {}", p.regime, p.phi, p.stokes, p.restitution,
                                         p.friction, p.share, p.binary ? 1 : 0, p.pushed ? 1 : 0, p.seed)};
  for (const std::string& set : options_.overrides) a.insert(a.end(), {"--set", set});
  return a;
}

std::vector<BoxResult> Boxes::results() const {
  std::vector<BoxResult> all;
  for (const BoxPoint& p : points_) {
    auto box = read_box(file_of(directory_, scene_, p), box_hash(scene_, p));
    if (!box)
      throw core::FileError(file_of(directory_, scene_, p).string() + ": the box that should lie here is not whole");
    all.push_back(*box);
  }
  return all;
}

}  // namespace polybed::multiscale
