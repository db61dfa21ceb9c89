// The command line of polybed: the only place that sees CLI11, catches, and exits.
#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include "core/error.hpp"
#include "core/version.hpp"
#include "multiscale/commands/options.hpp"

namespace {

using namespace polybed;

/// How the program ends: its code, and what it says of it.
struct Ending {
  int code = 0;
  std::string message;
};

/// MPI around everything that needs it.
class Mpi {
 public:
  Mpi(int& argc, char**& argv) {
    if (MPI_Init(&argc, &argv) != MPI_SUCCESS) throw core::MpiError("MPI cannot be started");
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  }
  ~Mpi() { MPI_Finalize(); }
  Mpi(const Mpi&) = delete;
  Mpi& operator=(const Mpi&) = delete;

  [[nodiscard]] bool first() const { return rank_ == 0; }

  /// An error that all ranks have met is told once. One that the others do not know of would leave them waiting for
  /// ever: after some seconds it is told by the rank that met it, which ends them all.
  void agree_on(Ending& ending) const {
    if (ranks_ == 1 || ending.code == 0) return;
    MPI_Request all_here = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &all_here);
    for (int tenths = 0, done = 0; tenths < 50; ++tenths) {
      MPI_Test(&all_here, &done, MPI_STATUS_IGNORE);
      if (done != 0) {
        if (!first()) ending.message.clear();
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    fmt::print(stderr, "rank {}: {}\n", rank_, ending.message);
    MPI_Abort(MPI_COMM_WORLD, ending.code);
  }

 private:
  int ranks_ = 1, rank_ = 0;
};

/// Whether this process is one of mpirun's, by what Open MPI or MPICH say to those that they start.
bool started_by_mpirun() {
  return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMI_SIZE") != nullptr;
}

void add_case(CLI::App& command, multiscale::CaseOptions& options, bool required = true) {
  command.add_option("CASE", options.case_path, "the case file")->required(required);
  command.add_option("--set", options.overrides, "KEY=VALUE, in place of what the file says")
      ->take_all()
      ->allow_extra_args(false);
  command.add_flag("--json", options.json, "one JSON object on standard output, nothing else there");
}

/// A command that runs a case, by a model of that name or by both.
CLI::App& add_run(CLI::App& app, const std::string& model, const std::string& help, multiscale::RunOptions& options) {
  CLI::App& command = *app.add_subcommand(model, help);
  add_case(command, options);
  command.add_option("-o,--output", options.output, "run directory; default runs/<case name>-" + model);
  command.add_option("--until", options.until, "simulated time, e.g. \"20 s\"");
  command.add_flag("--resume", options.resume, "go on from the checkpoint in the run directory");
  command.add_flag("--force", options.force, "replace a run directory that exists");
  command.add_flag("--quiet", options.quiet, "no progress");
  command.add_flag("!--no-picture", options.picture,
                   "no picture.png (or comparison.html) at the end, which takes a second");
  return command;
}

void add_estimate(CLI::App& app, multiscale::EstimateOptions& options) {
  CLI::App& command = *app.add_subcommand("estimate", "time, memory and disk of a run, and what would make it cheaper");
  add_case(command, options, false);
  command.add_option("--model", options.model, "tfm | dem")->check(CLI::IsMember({"tfm", "dem"}));
  command.add_option("--ranks", options.ranks, "that will share the case")->check(CLI::Range(1, 1000000));
  command.add_option("--probe", options.probe, "run the case itself for so long first, e.g. 5s");
  command.add_flag("--machine", options.machine, "measure this machine (30 s) and keep what was found");
}

void add_cost(CLI::App& app, multiscale::CostOptions& options) {
  CLI::App& command = *app.add_subcommand("cost", "error against time for a case, and the settings that follow");
  command.add_option("WORDS", options.words, "CASE; check DIR; diff OLD NEW; selftest")->required();
  command.add_option("--set", options.overrides, "KEY=VALUE, in place of what the file says")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("-o,--output", options.output, "folder; default runs/<case name>-cost");
  command.add_option("--until", options.until, "simulated time, e.g. \"20 s\"");
  command.add_option("--model", options.model, "tfm | dem")->check(CLI::IsMember({"tfm", "dem"}));
  command.add_option("--qoi", options.quantities, "quantities by commas; the first ranks");
  command.add_option("--axes", options.axes, "axes by commas");
  command.add_option("--target", options.target, "error, e.g. 1%");
  command.add_option("--budget", options.budget, "wall time, e.g. 20min");
  command.add_option("--repeat", options.repeat, "runs for a CPU time")->check(CLI::Range(3, 100));
  command.add_option("--clock", options.clock, "work | cpu | wall")->check(CLI::IsMember({"work", "cpu", "wall"}));
  command.add_option("--reference", options.reference, "auto | exact | DIR of a run");
  command.add_option("--seed", options.seed, "of the order of repetitions");
  command.add_flag("--resume", options.resume, "go on with the runs in the folder");
  command.add_flag("--force", options.force, "replace a sweep that exists");
  command.add_flag("--quiet", options.quiet, "no progress");
  command.add_flag("--json", options.json, "cost.json on standard output");
  command.add_flag("!--no-picture", options.picture, "no cost.png and cost.svg");
}

void add_stability(CLI::App& app, multiscale::StabilityOptions& options) {
  CLI::App& command = *app.add_subcommand("stability", "hard cases against every scheme: what held, cell by cell");
  command.add_option("--suite", options.suite, "ci: in some minutes | full")->check(CLI::IsMember({"ci", "full"}));
  command.add_option("--only", options.only, "cases, by commas, e.g. T7,C4");
  command.add_option("--schemes", options.schemes, "by commas, e.g. implicit/limited");
  command.add_option("--naive", options.naive, "textbook treatments, by commas, or all: test builds alone");
  command.add_option("--fuzz", options.draws, "that many scenes drawn from the envelope, in place of the catalogue");
  command.add_option("--draw", options.draw, "of these scenes those numbers alone, by commas, e.g. 738,965")
      ->delimiter(',');
  command.add_option("--seed", options.seed, "of the draws");
  command.add_option("-j,--jobs", options.jobs, "cells at once")->check(CLI::Range(1, 256));
  command.add_option("-o,--output", options.output, "default runs/stability");
  command.add_flag("--json", options.json, "one JSON object on standard output, nothing else there");
}

int exit_code(core::ExitCode code) { return static_cast<int>(code); }

Ending failed(core::ExitCode code, const std::string& message) { return {exit_code(code), message}; }

Ending guarded(const std::function<int()>& work) {
  try {
    return {work(), ""};
  } catch (const core::CaseError& error) {
    return failed(core::ExitCode::wrong_case, error.what());
  } catch (const core::NumericsError& error) {
    return failed(core::ExitCode::numerics, error.what());
  } catch (const core::FileError& error) {
    return failed(core::ExitCode::file, error.what());
  } catch (const core::MpiError& error) {
    return failed(core::ExitCode::mpi, error.what());
  } catch (const core::Stopped& error) {
    return failed(core::ExitCode::stopped, error.what());
  } catch (const std::bad_alloc&) {
    return failed(core::ExitCode::wrong_case, "not enough memory: choose fewer column.cells");
  } catch (const std::system_error& error) {  // a file system or standard output
    return failed(core::ExitCode::file, error.what());
  } catch (const std::exception& error) {
    return failed(core::ExitCode::numerics, error.what());
  }
}

/// What was printed has to have arrived: a full disk shows only when the buffer is emptied.
void flush_standard_output() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw core::FileError(fmt::format("standard output: cannot be written ({})", std::strerror(errno)));
}

int run(int argc, char** argv, std::optional<Mpi>& mpi) {
  using namespace multiscale;
  CLI::App app{"polybed: beds of particles of several sizes and densities in a liquid or a gas"};
  const std::string kind = core::build_kind().empty() ? "" : ", built with " + core::build_kind();
  app.set_version_flag("--version", "polybed " + core::version() + " (" + core::git_commit() + ")" + kind);
  app.require_subcommand(1);

  RunOptions tfm, dem;
  add_run(app, "tfm", "run the case as a continuum (two-fluid model)", tfm)
      .add_flag("--stress-uncertainty", tfm.stress_uncertainty,
                "again with the stress table at plus and minus one standard error: the band of the bed height");
  add_run(app, "dem", "run the case particle by particle", dem);

  CompareOptions compare;
  CLI::App& compare_command =
      add_run(app, "compare", "run the case by both models, or take runs of it: how far they agree", compare);
  compare_command.add_option("--tfm", compare.tfm, "directory of a run of polybed tfm, finished or not");
  compare_command.add_option("--dem", compare.dem, "directory of a run of polybed dem, finished or not");
  compare_command.add_option("--inversion", compare.inversion,
                             "folder of polybed inversion --scan both; default that of the case in runs/");

  CaseOptions check;
  add_case(*app.add_subcommand("check", "the case, resolved, and what it will need; nothing is run"), check);

  CaseOptions effects;
  CLI::App* effects_command =
      app.add_subcommand("effects", "which effects the scene calls for, with the number that decides each");
  add_case(*effects_command, effects);
  effects_command->get_option("CASE")->required(false);
  effects_command->require_subcommand(0, 1);
  std::string audited;
  bool audit_json = false;
  CLI::App* audit_command = effects_command->add_subcommand(
      "audit", "what a run has left out, evaluated on all that it stored; code 3 if that breaks the promise");
  audit_command->add_option("RUN", audited, "run directory")->required();
  audit_command->add_flag("--json", audit_json, "one JSON object");
  int bench_rounds = 3;
  bool bench_json = false;
  CLI::App* bench_command =
      effects_command->add_subcommand("bench", "what each effect costs per particle, contact or cell on this machine");
  bench_command->add_option("--rounds", bench_rounds, "repetitions; the least times are told")
      ->check(CLI::Range(1, 1000));
  bench_command->add_flag("--json", bench_json, "one JSON object");

  EstimateOptions estimate;
  add_estimate(app, estimate);

  CostOptions cost;
  add_cost(app, cost);

  DragOptions drag;
  std::string guard = "on";
  CLI::App* drag_command =
      app.add_subcommand("drag", "evaluate a drag closure at a point, or for every row of a CSV file");
  drag_command->add_option("--law", drag.law, "see polybed list");
  drag_command->add_option("--voidage", drag.voidage, "eps");
  drag_command->add_option("--re", drag.reynolds, "Reynolds number of the diameter and the superficial slip velocity");
  drag_command->add_option("--csv", drag.csv, "file with columns eps,Re or eps,Re,x1,D1,x2,D2,...");
  drag_command->add_option("--guard", guard, "on | off: the bare published formula")
      ->check(CLI::IsMember({"on", "off"}));
  drag_command->add_flag("--json", drag.json, "one JSON object");

  InversionOptions inversion;
  CLI::App* inversion_command =
      app.add_subcommand("inversion", "the inversion point of two species: by force balance, or by a scan of runs");
  add_case(*inversion_command, inversion);
  inversion_command->add_option("--law", inversion.law, "drag law in place of the case's");
  inversion_command->add_option("--temperature", inversion.temperature, "in place of the case's, e.g. \"20 degC\"");
  inversion_command->add_option("--method", inversion.method,
                                "force_balance | bulk_density | expansion | density_maximum | all");
  inversion_command->add_option("--scan", inversion.scan, "by runs instead: tfm | dem | both")
      ->check(CLI::IsMember({"tfm", "dem", "both"}));
  inversion_command->add_option("--from", inversion.from, "lowest velocity of the first bracket, e.g. \"30 mm/s\"");
  inversion_command->add_option("--to", inversion.to, "highest; default a quarter about the force balance");
  inversion_command->add_option("-o,--output", inversion.output,
                                "folder of a scan; default runs/<case name>-inversion");
  inversion_command->add_option("--until", inversion.until, "simulated time of each run, e.g. \"20 s\"");
  inversion_command->add_flag("--stress-uncertainty", inversion.stress_uncertainty,
                              "of a scan by the TFM: again with its stress table at plus and minus one standard error");
  inversion_command->add_flag("--quiet", inversion.quiet, "no line for each run");
  inversion_command->add_flag("!--no-picture", inversion.picture, "no inversion.png at the end");

  CalibrateOptions calibrate;
  CLI::App* calibrate_command = app.add_subcommand(
      "calibrate", "run boxes of particles and make a table of the solids stress for the two-fluid model");
  add_case(*calibrate_command, calibrate);
  calibrate_command->add_option("-o,--output", calibrate.output, "directory; default runs/<case name>-calibrate");
  calibrate_command->add_option("-j,--jobs", calibrate.jobs, "boxes at once; default 1")->check(CLI::Range(1, 1024));
  CLI::Option* plan =
      calibrate_command->add_flag("--plan", calibrate.plan_only, "which boxes, and how long; nothing is run");
  calibrate_command
      ->add_option("--check", calibrate.check, "TABLE: run a few points that it was not fitted to, and compare")
      ->excludes(plan);
  calibrate_command->add_option("--bed", calibrate.bed,
                                "TABLE of fluidised boxes (regime bed): its p_bed is put beside what is sheared");
  calibrate_command->add_option("--box", calibrate.box)->group("");
  calibrate_command->add_flag("--quiet", calibrate.quiet, "no progress");

  PlotOptions plot;
  CLI::App* plot_command = app.add_subcommand("plot", "pictures of a finished or a running run");
  plot_command->add_option("RUN", plot.run, "run directory, or the case of a run in runs/")->required();
  plot_command->add_option(
      "--what", plot.what,
      "overview | fields | particles | profiles | history | animation, several by commas; default all");
  plot_command->add_option("--time", plot.time, "the stored time nearest to it, e.g. \"5 s\"; default the last");
  plot_command->add_option("-o,--out,--output", plot.output, "folder of the pictures; default RUN/pictures");
  plot_command->add_option("--format", plot.format, "png | svg")->check(CLI::IsMember({"png", "svg"}));
  plot_command->add_option("--rate", plot.rate, "frames per second of the animation; default: it lasts about 12 s")
      ->check(CLI::Range(0.1, 120.0));
  plot_command->add_flag("--quiet", plot.quiet, "no progress");
  plot_command->add_flag("--json", plot.json, "one JSON object: the files written");
  StabilityOptions hard;
  add_stability(app, hard);
  bool schema_json = false, schema_markdown = false, list_json = false, explain_json = false;
  CLI::App* schema = app.add_subcommand("schema", "all keys of the case file");
  schema->add_flag("--json", schema_json, "as JSON");
  schema->add_flag("--markdown", schema_markdown, "as the page of the documentation");
  std::string key;
  CLI::App* explain = app.add_subcommand("explain", "one key with its range, default and equation");
  explain->add_option("KEY", key, "e.g. tfm.rtol")->required();
  explain->add_flag("--json", explain_json, "as JSON");
  app.add_subcommand("list", "the effects and their laws")->add_flag("--json", list_json, "as JSON");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == 0;
    app.exit(error);
    return asked ? 0 : exit_code(core::ExitCode::wrong_case);
  }
  drag.guard = guard == "on";
  if (app.got_subcommand("cost")) {
    const core::ExitCode code = run_cost(cost);
    flush_standard_output();
    return exit_code(code);
  }
  if (app.got_subcommand("plot")) return exit_code(run_plot(plot));
  if (app.got_subcommand("stability")) {
    const core::ExitCode code = hard.draws > 0 || !hard.draw.empty() ? run_fuzz(hard) : run_stability(hard);
    flush_standard_output();
    return exit_code(code);
  }
  // Starting MPI takes 0.3 s, which commands that only compute a number need not wait for.
  for (const char* command : {"tfm", "dem", "compare", "check", "estimate"})
    if (app.got_subcommand(command)) mpi.emplace(argc, argv);
  if (!inversion.scan.empty()) mpi.emplace(argc, argv);
  if (app.got_subcommand("tfm")) run_tfm(tfm);
  if (app.got_subcommand("dem")) run_dem(dem);
  if (app.got_subcommand("compare")) run_compare(compare);
  if (app.got_subcommand("check") && mpi->first()) run_check(check);
  if (app.got_subcommand("calibrate")) {
    calibrate.launched = started_by_mpirun() && calibrate.box.empty();
    if (calibrate.launched || calibrate.box.starts_with("bed")) mpi.emplace(argc, argv);
    run_calibrate(calibrate);
  }
  if (app.got_subcommand("effects")) {
    if (audit_command->parsed()) return exit_code(run_effects_audit(audited, audit_json));
    if (bench_command->parsed())
      run_effects_bench(bench_rounds, bench_json);
    else if (effects.case_path.empty())
      throw core::CaseError("effects: name a CASE, audit RUN, or bench");
    else
      run_effects(effects);
  }
  if (app.got_subcommand("estimate") && mpi->first()) run_estimate(estimate);
  if (app.got_subcommand("drag")) run_drag(drag);
  if (app.got_subcommand("inversion")) run_inversion(inversion);
  if (app.got_subcommand("schema")) run_schema(schema_json, schema_markdown);
  if (app.got_subcommand("explain")) run_explain(key, explain_json);
  if (app.got_subcommand("list")) run_list(list_json);
  flush_standard_output();
  return exit_code(core::ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is told like a full disk
  std::optional<Mpi> mpi;
  Ending ending = guarded([&] { return run(argc, argv, mpi); });
  if (mpi) mpi->agree_on(ending);
  if (!ending.message.empty()) fmt::print(stderr, "{}\n", ending.message);
  return ending.code;
}
