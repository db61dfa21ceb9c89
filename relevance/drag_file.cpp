#include "relevance/drag_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>

#include "core/case/file.hpp"
#include "core/case/keys.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "relevance/drag_law.hpp"

namespace polybed::relevance {

namespace {

constexpr std::string_view prefix = "file:", filetype = "polybed drag law";
constexpr std::size_t longest_law_file = 10'000'000;
constexpr std::array known_keys{"filetype", "version", "form", "constants",       "law",        "common", "tilt",
                                "range",    "band",    "fit",  "partition_bands", "git_commit", "created"};

/// Reads a law file and collects its problems, each with its line and column.
class DragFileReader {
 public:
  explicit DragFileReader(const std::filesystem::path& path)
      : name_(path.string()), text_(core::read_text(path, longest_law_file)) {}

  DragFile read() {
    parse();
    DragFile file;
    file.hash = core::text_hash(text_);
    check_kind();
    for (const auto& [key, value] : json_.items()) check_key(key);
    read_law(file);
    file.common = factor("common", 1, 0.1, 10);
    file.tilt = factor("tilt", 0, -0.5, 0.5);
    if (json_.contains("range")) read_range(file.range.emplace());
    finish();
    check_usable(file);
    finish();
    return file;
  }

 private:
  void parse() {
    try {
      json_ = core::parse_json(text_);
    } catch (const core::FileError& error) {
      const std::string what = error.what();
      core::CaseProblem problem{name_, 0, 0, what};
      if (const std::size_t at = what.find("line "); at != std::string::npos)
        std::sscanf(what.c_str() + at, "line %d, column %d", &problem.line, &problem.column);
      throw core::CaseError(std::vector{problem});
    }
    if (!json_.is_object()) throw core::CaseError(std::vector{core::CaseProblem{name_, 1, 1, "expected an object"}});
  }

  /// Reports a problem. The keys of a law file are unique, so the first quoted key is the right one.
  void wrong(const std::string& key, const std::string& message) {
    core::CaseProblem problem{name_, 0, 0, message};
    if (const std::size_t at = key.empty() ? std::string::npos : text_.find('"' + key + '"'); at != std::string::npos) {
      problem.line = 1 + int(std::count(text_.begin(), text_.begin() + std::ptrdiff_t(at), '\n'));
      problem.column = int(at - (text_.rfind('\n', at) == std::string::npos ? 0 : text_.rfind('\n', at) + 1)) + 1;
    }
    problems_.push_back(problem);
  }

  void finish() const {
    if (!problems_.empty()) throw core::CaseError(problems_);
  }

  void check_kind() {
    if (json_.value("filetype", core::Json()) != filetype)
      wrong("filetype", "no drag law: expected \"filetype\": \"polybed drag law\"");
    else if (json_.value("version", core::Json()) != 1)
      wrong("version", "version: expected 1, the only one that this program reads");
    finish();
  }

  void check_key(const std::string& key) {
    const std::vector<std::string> known(known_keys.begin(), known_keys.end());
    if (std::find(known.begin(), known.end(), key) == known.end()) wrong(key, unknown("key", key, known));
  }

  static std::string unknown(const std::string& what, const std::string& name, const std::vector<std::string>& known) {
    const std::string near = core::nearest_name(name, known);
    return fmt::format("unknown {} '{}'; {}", what, name,
                       near.empty() ? fmt::format("allowed are {}", fmt::join(known, " | "))
                                    : fmt::format("did you mean '{}'?", near));
  }

  void read_law(DragFile& file) {
    const bool by_form = json_.contains("form");
    if (by_form == json_.contains("law")) {
      wrong("law", "give either \"form\", with \"constants\", or \"law\"");
      return;
    }
    const char* key = by_form ? "form" : "law";
    if (!json_[key].is_string()) return wrong(key, fmt::format("{}: expected a name in quotes", key));
    std::string& name = by_form ? file.form : file.law;
    name = json_[key].get<std::string>();
    if (by_form) return read_constants(file);
    if (const auto known = closures::drag_law_names(); std::find(known.begin(), known.end(), name) == known.end())
      wrong("law", unknown("drag law", name, known));
    if (json_.contains("constants")) wrong("constants", "constants say nothing of a law of the menu: give \"form\"");
  }

  void read_constants(DragFile& file) {
    const std::vector<closures::DragForm> forms = closures::drag_forms();
    const auto form = std::find_if(forms.begin(), forms.end(), [&](const auto& f) { return f.name == file.form; });
    std::vector<std::string> names;
    for (const auto& f : forms) names.push_back(f.name);
    if (form == forms.end()) return wrong("form", unknown("form", file.form, names));
    const core::Json given = json_.value("constants", core::Json());
    if (!given.is_object()) return wrong("constants", "constants: expected an object of name and number");
    names.clear();
    for (const closures::DragFormConstant& constant : form->constants) {
      names.push_back(constant.name);
      if (!given.contains(constant.name))
        wrong("constants", fmt::format("constants.{} is missing: {} needs all its constants, {:g} as published",
                                       constant.name, file.form, constant.published));
    }
    for (const auto& [name, value] : given.items()) {
      if (std::find(names.begin(), names.end(), name) == names.end())
        wrong(name, unknown("constant", name, names));
      else if (!value.is_number() || !(value.get<double>() > 0) || !std::isfinite(value.get<double>()))
        wrong(name, fmt::format("constants.{} = {}: expected a number above 0", name, value.dump()));
      else
        file.constants[name] = value.get<double>();
    }
  }

  double factor(const char* key, double standard, double least, double most) {
    if (!json_.contains(key)) return standard;
    const core::Json& value = json_[key];
    if (value.is_number() && value.get<double>() >= least && value.get<double>() <= most) return value.get<double>();
    wrong(key, fmt::format("{} = {}: expected a number from {:g} to {:g}", key, value.dump(), least, most));
    return standard;
  }

  void read_range(closures::FittedRange& range) {
    const core::Json& given = json_["range"];
    if (!given.is_object() || given.size() != 2 || !given.contains("voidage") || !given.contains("reynolds"))
      return wrong("range", R"(range: expected {"voidage": [LEAST, MOST], "reynolds": [LEAST, MOST]})");
    std::tie(range.least_voidage, range.most_voidage) = interval("voidage", 1);
    std::tie(range.least_reynolds, range.most_reynolds) = interval("reynolds", HUGE_VAL);
  }

  /// Two numbers in order, of a key of the range. \param most  allowed
  std::pair<double, double> interval(const char* key, double most) {
    const core::Json& value = json_["range"][key];
    const bool numbers = value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
    const auto [from, to] = numbers ? std::pair(value[0].get<double>(), value[1].get<double>()) : std::pair(1.0, 0.0);
    if (!(from >= 0 && from <= to && to <= most))
      wrong(key, fmt::format("range.{} = {}: expected two numbers in order, from 0{}", key, value.dump(),
                             std::isfinite(most) ? fmt::format(" to {:g}", most) : ""));
    return {from, to};
  }

  void check_usable(const DragFile& file) {
    if (file.form.empty()) return;
    if (const auto at = closures::unusable_at(law_of_file(file, closures::Guard::on)))
      wrong("constants", fmt::format("with these constants the drag of one size is {:.4g} at voidage {:.4g} and "
                                     "Reynolds number {:.4g}, or its force falls there as the velocity rises: no "
                                     "solver can run with it",
                                     at->f, at->voidage, at->reynolds));
  }

  std::string name_, text_;
  core::Json json_;
  std::vector<core::CaseProblem> problems_;
};

}  // namespace

DragFile read_drag_file(const std::filesystem::path& path) { return DragFileReader(path).read(); }

std::string record_of(const std::filesystem::path& path, const DragFile& file) {
  core::Json law = {{"file", path.string()}, {"hash", file.hash}};
  if (file.form.empty())
    law["law"] = file.law;
  else
    law.update({{"form", file.form}, {"constants", file.constants}});
  law.update({{"common", file.common}, {"tilt", file.tilt}, {"range", nullptr}});
  if (const auto& range = file.range)
    law["range"] = {{"voidage", {range->least_voidage, range->most_voidage}},
                    {"reynolds", {range->least_reynolds, range->most_reynolds}}};
  return core::json_text(law);
}

closures::DragLaw law_of_file(const DragFile& file, closures::Guard guard) {
  closures::DragLaw law = file.form.empty() ? closures::drag_law(file.law, guard)
                                            : closures::fitted_drag_law(file.form, file.constants, guard);
  law.common = file.common;
  law.tilt = file.tilt;
  law.fitted_to = file.range;
  return law;
}

std::string fitted_range(const closures::DragLaw& law) {
  if (const auto& range = law.fitted_to)
    return fmt::format("voidage {:.4g} to {:.4g}, Re {:.4g} to {:.4g}", range->least_voidage, range->most_voidage,
                       range->least_reynolds, range->most_reynolds);
  const bool fitted = std::holds_alternative<closures::MixtureFittedCello>(law.law) ||
                      std::holds_alternative<closures::MixtureFittedBrinkmanOseen>(law.law);
  return fitted ? "unknown" : "";
}

std::optional<std::string> drag_file(const std::string& law) {
  return law.starts_with(prefix) ? std::optional(law.substr(prefix.size())) : std::nullopt;
}

closures::DragLaw drag_law_named(const std::string& law, const std::string& partition, closures::Guard guard) {
  const std::optional<std::string> path = drag_file(law);
  if (!path) return closures::drag_law(law, partition, guard);
  const DragFile file = read_drag_file(*path);
  return closures::shared_by(law_of_file(file, guard), file.form.empty() ? file.law : law, partition, guard);
}

std::vector<std::string> other_shapes(const core::Scene& scene) {
  std::vector<std::string> others;
  if (!core::acts(scene, "shape") || core::all_spheres(scene)) return others;
  for (const closures::ShapeLaw& law : closures::shape_laws)
    if (law.name != closures::shape_law_named(core::law_of(scene, "shape")).name) others.emplace_back(law.name);
  return others;
}

closures::ShapeFactor shape_of(const core::Scene& scene, const core::Species& species) {
  const std::string name = core::law_of(scene, "shape");
  return core::is_off(name) ? closures::ShapeFactor()
                            : closures::shape_factor(closures::shape_law_named(name), species.sphericity);
}

closures::DragLaw with_shape(closures::DragLaw law, const core::Scene& scene) {
  if (!core::acts(scene, "shape") || core::all_spheres(scene)) return law;
  std::vector<double> sphericity, diameter, share = scene.bed.volume_share;
  closures::BedShape& shape = law.shape.emplace();
  for (const core::Species& species : scene.species) {
    shape.species.push_back(shape_of(scene, species));
    sphericity.push_back(species.sphericity);
    diameter.push_back(species.diameter);
  }
  if (share.size() != sphericity.size() || !(std::accumulate(share.begin(), share.end(), 0.0) > 0))
    share.assign(sphericity.size(), 1);  // not known
  core::Species mean;
  mean.sphericity = closures::mean_sphericity(sphericity, share, diameter);
  shape.mean = shape_of(scene, mean);
  return law;
}

}  // namespace polybed::relevance
