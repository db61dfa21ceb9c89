// polybed new and polybed list cases: the shipped cases.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <tuple>

#include "app/commands.hpp"
#include "app/explain.hpp"
#include "core/case/keys.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "multiscale/program.hpp"

namespace polybed::app {

namespace {

namespace fs = std::filesystem;

/// A shipped case.
struct KnownCase {
  std::string name, title;
  std::string takes;  ///< "5 s: polybed tfm"; empty: unknown
  fs::path folder;
  bool is_template = false;
};

/// The rest of the first line with this beginning, without quotes; empty if there is none.
std::string after(const std::string& text, const std::string& front) {
  const std::string lines = "\n" + text;
  const std::size_t at = lines.find("\n" + front);
  if (at == std::string::npos) return "";
  std::string rest = lines.substr(at + 1 + front.size());
  rest = rest.substr(0, rest.find('\n'));
  std::erase(rest, '"');
  return rest;
}

/// All of a folder of templates, or those that say so where they name the time.
std::vector<KnownCase> cases_in(const fs::path& folder, bool templates) {
  std::vector<KnownCase> found;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const fs::path file = entry.path() / "case.toml";
    if (!fs::exists(file)) continue;
    const std::string text = core::read_text(file);
    const std::string marked = after(text, "# a template; takes ");
    found.push_back({entry.path().filename().string(), after(text, "title = "),
                     marked.empty() ? after(text, "# takes ") : marked, entry.path(), templates || !marked.empty()});
  }
  return found;
}

/// Templates first.
std::vector<KnownCase> known_cases() {
  const fs::path cases = beside_program(POLYBED_CASES_INSTALLED, POLYBED_CASES_SOURCE);
  std::vector<KnownCase> all = cases_in(cases / "templates", true);
  const std::vector<KnownCase> shipped = cases_in(cases, false);
  all.insert(all.end(), shipped.begin(), shipped.end());
  if (all.empty()) throw core::FileError(fmt::format("{}: no cases there", cases.string()));
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::tie(b.is_template, a.name) < std::tie(a.is_template, b.name);
  });
  return all;
}

KnownCase case_named(const std::string& name) {
  const std::vector<KnownCase> all = known_cases();
  std::string templates;
  for (const KnownCase& one : all)
    if (one.is_template) templates += (templates.empty() ? "; there are " : ", ") + one.name;
  templates += " (polybed list cases says what they are)";
  if (name.empty()) throw core::CaseError("--from TEMPLATE is missing" + templates);
  const auto found = std::find_if(all.begin(), all.end(), [&](const KnownCase& one) { return one.name == name; });
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const KnownCase& one : all) names.push_back(one.name);
  std::string near = core::nearest_name(name, names);
  for (const std::string& one : names)
    if (near.empty() && one.find(name) != std::string::npos) near = one;  // "liquid" in "liquid-bed"
  throw core::CaseError(
      fmt::format("--from {}: no such template{}", name, near.empty() ? templates : "; did you mean '" + near + "'?"));
}

/// Files that a case reads; descriptions and evaluations are not copied.
bool belongs_to_case(const fs::path& file) {
  constexpr std::array<std::string_view, 3> kinds{".toml", ".csv", ".h5"};
  return std::find(kinds.begin(), kinds.end(), file.extension().string()) != kinds.end();
}

void run_new(const fs::path& name, const std::string& from) {
  const KnownCase chosen = case_named(from);
  if (fs::exists(name / "case.toml"))
    throw core::CaseError(fmt::format("{} exists already: choose another name", (name / "case.toml").string()));
  core::make_directories(name);
  for (const fs::directory_entry& entry : fs::directory_iterator(chosen.folder))
    if (belongs_to_case(entry.path()))
      core::write_atomically(name / entry.path().filename(), core::read_text(entry.path()));
  const std::string file = core::shell_word((name / "case.toml").string());
  core::print("{}: {}\n{}", file, chosen.title, chosen.takes.empty() ? "" : "takes about " + chosen.takes + "\n");
  const std::string program = typed_program();
  core::print("next:\n  {} check {}\n", program, file);
  for (const std::string command : {"tfm", "dem", "calibrate"})
    if (chosen.takes.find("polybed " + command) != std::string::npos)
      core::print("  {} {} {}\n", program, command, file);
}

}  // namespace

void run_list_cases(bool json) {
  const std::vector<KnownCase> all = known_cases();
  if (json) {
    core::Json rows = core::Json::array();
    for (const KnownCase& one : all)
      rows.push_back({{"name", one.name}, {"title", one.title}, {"takes", one.takes}, {"template", one.is_template}});
    return core::print("{}\n", core::json_text({{"cases", rows}}));
  }
  bool templates = false;
  for (const KnownCase& one : all) {
    if (one.is_template && !templates) core::print("templates: polybed new NAME --from TEMPLATE\n");
    if (!one.is_template && templates) core::print("\nshipped cases, each with a README; polybed new takes them too\n");
    templates = one.is_template;
    const std::size_t title = 27;
    core::put(stdout, core::Colour::bold, fmt::format("{:26}", one.name));
    core::put(stdout, beside(std::string(title - 1, ' '), title, one.title).substr(title - 1));
    if (!one.takes.empty()) core::print("{:25}  takes {}\n", "", one.takes);
  }
  core::print("\ntimes are of one core of the machine that they were measured on, with the pictures at the end\n");
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

}  // namespace polybed::app
