// Commands that answer a question without a run.
#include "app/commands.hpp"

namespace polybed::app {

namespace {

On only_first_rank() { return On::first_rank; }

struct EffectsOptions {
  CaseOptions scene;
  std::string audited;
  bool audit_json = false, details = false, bench_json = false;
  int bench_rounds = 3;
};

core::ExitCode run_effects(const EffectsOptions& options, bool audit, bool bench) {
  if (audit) return run_effects_audit(options.audited, options.audit_json);
  if (bench)
    run_effects_bench(options.bench_rounds, options.bench_json);
  else if (options.scene.case_path.empty())
    throw core::CaseError("effects: name a CASE, audit RUN, or bench");
  else
    run_effects(options.scene, options.details);
  return core::ExitCode::done;
}

}  // namespace

void add_check(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<RunOptions>();
  const auto resolved = std::make_shared<bool>(false);
  CLI::App& command = *app.add_subcommand("check", "what to expect of a case and what it will need; nothing is run");
  take_case(command, *options);
  command.add_option("--until", options->until, "simulated time, e.g. \"20 s\"");
  command.add_flag("--details", options->details, "the numerics, memory and all notes instead of one screen");
  command.add_flag("--resolved", *resolved, "print the case with all defaults instead");
  commands.push_back({&command,
                      doing([options, resolved] { *resolved ? print_resolved(*options) : run_check(*options); }),
                      [resolved] { return *resolved ? On::one_process : On::first_rank; }});
}

void add_effects(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<EffectsOptions>();
  CLI::App& command =
      *app.add_subcommand("effects", "which effects the scene calls for, with the number that decides each");
  take_case(command, options->scene, false);
  command.add_flag("--details", options->details, "the reason of every row");
  command.require_subcommand(0, 1);
  CLI::App* audit = command.add_subcommand(
      "audit", "what a run has left out, evaluated on all that it stored; code 3 if that exceeds the bound");
  audit->add_option("RUN", options->audited, "run directory")->required();
  audit->add_flag("--json", options->audit_json, "one JSON object");
  CLI::App* bench =
      command.add_subcommand("bench", "what each effect costs per particle, contact or cell on this machine");
  bench->add_option("--rounds", options->bench_rounds, "repetitions; the least times are told")
      ->check(CLI::Range(1, 1000));
  bench->add_flag("--json", options->bench_json, "one JSON object");
  commands.push_back(
      {&command, [options, audit, bench] { return run_effects(*options, audit->parsed(), bench->parsed()); }});
}

void add_estimate(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<EstimateOptions>();
  CLI::App& command = *app.add_subcommand("estimate", "time, memory and disk of a run, and what would make it cheaper");
  take_case(command, *options, false);
  command.add_option("--model", options->model, "tfm | dem")->check(CLI::IsMember({"tfm", "dem"}));
  command.add_option("--ranks", options->ranks, "that will share the case")->check(CLI::Range(1, 1000000));
  command.add_option("--probe", options->probe, "run the case itself for so long first, e.g. 5s");
  command.add_flag("--machine", options->machine, "measure this machine (30 s) and keep what was found");
  commands.push_back({&command, doing([options] { run_estimate(*options); }), only_first_rank});
}

void add_new(CLI::App& app, Commands& commands) {
  struct Options {
    std::string name, from;
  };
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("new", "write a case to start from: NAME/case.toml");
  command.add_option("NAME", options->name, "folder of the new case")->required();
  command.add_option("--from", options->from, "a template or a shipped case: polybed list cases");
  commands.push_back({&command, doing([options] { run_new(options->name, options->from); })});
}

void add_drag(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<DragOptions>();
  const auto guard = std::make_shared<std::string>("on");
  CLI::App& command = *app.add_subcommand("drag", "evaluate a drag closure at a point, or for every row of a CSV file");
  command.add_option("--law", options->law, "see polybed list");
  command.add_option("--partition", options->partition, "that shares the law among species; see polybed list");
  command.add_option("--voidage", options->voidage, "eps");
  command.add_option("--re", options->reynolds, "Reynolds number of the diameter and the superficial slip velocity");
  command.add_option("--csv", options->csv, "file with columns eps,Re or eps,Re,x1,D1,x2,D2,...");
  command.add_option("--guard", *guard, "on | off: the bare published formula")->check(CLI::IsMember({"on", "off"}));
  command.add_flag("--json", options->json, "one JSON object");
  commands.push_back({&command, doing([options, guard] {
                        options->guard = *guard == "on";
                        run_drag(*options);
                      })});
}

void add_measure(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<MeasureOptions>();
  CLI::App& command = *app.add_subcommand("measure", "bed height, centres, mixing, ... of the profiles of a run");
  CLI::Option_group& what = *command.add_option_group("what");
  what.add_option("RUN", options->run, "run directory");
  what.add_option("--profiles", options->profiles, "JSON file of profiles instead; - reads standard input");
  CLI::Option* list = what.add_flag("--list", options->list, "instead: every measure with its unit and definition");
  what.require_option(1);
  command.add_flag("--markdown", options->markdown, "of the list: the page of the documentation")->needs(list);
  CLI::Option* json = command.add_flag("--json", options->json, "one JSON object");
  command.add_flag("--csv", options->csv, "comma-separated, in SI units")->excludes(json);
  commands.push_back({&command, doing([options] { run_measure(*options); })});
}

void add_keys(CLI::App& app, Commands& commands) {
  struct Options {
    bool json = false, markdown = false, details = false;
    std::string key;
  };
  const auto schema = std::make_shared<Options>(), explain = std::make_shared<Options>(),
             list = std::make_shared<Options>();
  CLI::App& all = *app.add_subcommand("schema", "all keys of the case file");
  all.add_flag("--json", schema->json, "as JSON");
  all.add_flag("--markdown", schema->markdown, "as the page of the documentation");
  commands.push_back({&all, doing([schema] { run_schema(schema->json, schema->markdown); })});
  CLI::App& one =
      *app.add_subcommand("explain", "a key, role, law, measure, status, invariant, limit or exit code: what it means");
  one.add_option("KEY", explain->key, "e.g. tfm.rtol, rtol, drag, cello, hollow, 3")->required();
  one.add_flag("--json", explain->json, "as JSON");
  commands.push_back({&one, doing([explain] { run_explain(explain->key, explain->json); })});
  CLI::App& laws = *app.add_subcommand("list", "the effects and their laws, or the cases to start from");
  laws.add_option("WHAT", list->key, "cases: templates and shipped cases, instead")->check(CLI::IsMember({"cases"}));
  laws.add_flag("--json", list->json, "as JSON");
  laws.add_flag("--details", list->details, "of laws: equations and references");
  commands.push_back({&laws, doing([list] {
                        list->key == "cases" ? run_list_cases(list->json) : run_list(list->json, list->details);
                      })});
}

}  // namespace polybed::app
