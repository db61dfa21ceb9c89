#include "core/case/rule.hpp"

#include <fmt/format.h>

namespace polybed::core {

std::vector<CaseProblem> Rule::problems(const Scene& scene) const {
  std::vector<CaseProblem> problems;
  const Broken found = broken(scene);
  for (const Broken::Fault& fault : found.faults()) {
    std::string text = message;
    std::size_t from = 0;
    for (const std::string& word : fault.words) {
      const std::size_t gap = text.find("{}", from);
      if (gap == std::string::npos) break;
      text.replace(gap, 2, word);
      from = gap + word.size();
    }
    problems.push_back(scene.places.problem(keys, std::move(text), fault.entry));
  }
  return problems;
}

std::vector<CaseProblem> problems_of(std::span<const Rule> rules, const Scene& scene, const WrongKeys& wrong) {
  std::vector<CaseProblem> all;
  for (const Rule& rule : rules) {
    if (!std::all_of(rule.keys.begin(), rule.keys.end(), [&](const std::string& key) { return wrong.sound(key); }))
      continue;
    for (CaseProblem& problem : rule.problems(scene)) all.push_back(std::move(problem));
  }
  return all;
}

std::vector<std::string> texts_of(const std::vector<CaseProblem>& problems) {
  std::vector<std::string> texts;
  for (const CaseProblem& problem : problems) texts.push_back(problem.text());
  return texts;
}

void refuse(std::span<const Rule> rules, const Scene& scene) {
  if (const std::vector<CaseProblem> problems = problems_of(rules, scene); !problems.empty()) throw CaseError(problems);
}

std::vector<CaseProblem> ModelRules::problems(const Scene& scene, const WrongKeys& wrong) const {
  std::vector<CaseProblem> problems = problems_of(cannot, scene, wrong);
  if (!problems.empty()) return problems;
  problems = problems_of(rules, scene, wrong);
  for (CaseProblem& problem : problems)
    problem.message = fmt::format("polybed {} cannot run it: {}", model, problem.message);
  return problems;
}

std::vector<CaseProblem> Rulebook::refusals(const Scene& scene, const WrongKeys& wrong, bool more) const {
  std::vector<CaseProblem> refusals = problems_of(rules, scene, wrong), of_its_models, of_others;
  bool runs = models.empty();
  for (const ModelRules* model : models) {
    const std::vector<CaseProblem> problems = model->problems(scene, wrong);
    runs = runs || problems.empty();
    std::vector<CaseProblem>& all = problems_of(model->cannot, scene, wrong).empty() ? of_its_models : of_others;
    all.insert(all.end(), problems.begin(), problems.end());
  }
  if (runs && refusals.empty() && !more) return {};
  const std::vector<CaseProblem>& told = runs || !of_its_models.empty() ? of_its_models : of_others;
  refusals.insert(refusals.end(), told.begin(), told.end());
  return refusals;
}

}  // namespace polybed::core
