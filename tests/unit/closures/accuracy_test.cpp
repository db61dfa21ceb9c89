// Accuracy of the drag laws against the lattice-Boltzmann data, and the page of the documentation that shows it.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "../../data/table.hpp"
#include "closures/drag.hpp"
#include "closures/forces.hpp"

namespace polybed::closures {
namespace {

using test::Table;

/// Mean and greatest relative error, in per cent, over points that are not missing.
struct Error {
  double sum = 0, most = 0;
  int points = 0;
  void see(double value, double data) {
    if (std::isnan(data)) return;
    const double e = 100 * std::abs(value / data - 1);
    sum += e;
    most = std::max(most, e);
    ++points;
  }
  [[nodiscard]] double mean() const { return sum / points; }
};

double f_of(const std::string& law, double eps, double re) {
  double f = 0, slope = 0;
  GuardCount count;
  drag_of_points(drag_law(law, Guard::on), {&eps, 1}, {&re, 1}, {&f, 1}, {&slope, 1}, count);
  return f;
}

Error of_one_size(const std::string& law) {
  Error error;
  for (const std::string name : {"A_i", "A_ii", "A_iii"}) {
    const Table table("lbm/tab_" + name + ".csv");
    for (std::size_t n = 0; n < table.rows(); ++n)
      error.see(f_of(law, table.number(n, "eps"), table.number(n, "Re")),
                table.number(n, name == "A_iii" ? "f_TL" : "f_LBM"));
  }
  return error;
}

/// Errors of alpha_j and n_j over the tables of two sizes.
struct MixtureError {
  Error alpha, net;
};

MixtureError of_two_sizes(const std::string& name_of_law) {
  MixtureError error;
  const DragLaw law = drag_law(name_of_law, Guard::on);
  for (const std::string name : {"A_iv", "A_v"}) {
    const Table table("lbm/tab_" + name + ".csv");
    for (std::size_t n = 0; n < table.rows(); ++n) {
      const double eps = table.number(n, "eps"), re = table.number(n, "Rebar"), x1 = table.number(n, "x1");
      const std::vector<double> share{x1, 1 - x1}, diameter{table.number(n, "D1_over_D2_used"), 1.0};
      const double mean = sauter_diameter(share, diameter);
      std::vector<double> f(2), slope(2), slip(2, re / mean);
      drag_of_mixture(law, eps, share, diameter, slip, 1, 1, f, slope);
      const double f_mean = drag_of_mean(law, eps, re, share, diameter, f);
      for (std::size_t j = 0; j < 2; ++j) {
        const double alpha = alpha_of_omega(eps, f[j] / f_mean, diameter[j] / mean);
        const std::string number = std::to_string(j + 1);
        error.alpha.see(alpha, table.number(n, "alpha" + number + "_LBM"));
        error.net.see(alpha * f_mean / eps, table.number(n, "n" + number + "_LBM"));
      }
    }
  }
  return error;
}

/// n_j of cello over the ten sizes of one of the systems I to IV, with the inferred y_m of the table.
Error of_system(const std::string& system) {
  Error error;
  for (const std::string name : {"B_i", "B_ii"}) {
    const Table table("lbm/tab_" + name + ".csv");
    for (std::size_t n = 0; n < table.rows(); ++n) {
      if (table.text(n, "system") != system) continue;
      const double eps = table.number(n, "eps"), y = table.number(n, "y_j");
      const double omega = y * (1 + cello_h(eps) * (y - 1) / table.number(n, "ym_used"));
      error.see(alpha_of_omega(eps, omega, y) * DragCello::bare(eps, table.number(n, "Rebar")).f / eps,
                table.number(n, "n_j_LBM"));
    }
  }
  return error;
}

/// The digits are those of an independent evaluation of the same tables; half of their last one is allowed.
void expect_percent(const Error& error, double mean, double most, double digit_of_mean, double digit_of_most) {
  EXPECT_NEAR(error.mean(), mean, 0.5 * digit_of_mean + 1e-9);
  EXPECT_NEAR(error.most, most, 0.5 * digit_of_most + 1e-9);
}

TEST(Accuracy, OneSize) {
  expect_percent(of_one_size("cello"), 2.57, 7.3, 0.01, 0.1);
  expect_percent(of_one_size("vbk"), 4.55, 61, 0.01, 1);
  expect_percent(of_one_size("hkl"), 8.95, 138, 0.01, 1);
}

TEST(Accuracy, TwoSizes) {
  const MixtureError cello = of_two_sizes("cello"), corrected = of_two_sizes("vbk_corrected"),
                     theory = of_two_sizes("vbk_theory");
  expect_percent(cello.alpha, 2.05, 19, 0.01, 1);
  expect_percent(corrected.alpha, 5.48, 44, 0.01, 1);
  expect_percent(theory.alpha, 3.57, 21, 0.01, 1);
  expect_percent(cello.net, 6.55, 27.5, 0.01, 0.1);
  expect_percent(corrected.net, 5.415, 28, 0.01, 1);
}

TEST(Accuracy, TenSizes) {
  const std::pair<const char*, double> expected[] = {{"I", 3.31}, {"II", 5.46}, {"III", 2.54}, {"IV", 3.54}};
  for (const auto& [system, mean] : expected) EXPECT_NEAR(of_system(system).mean(), mean, 0.005 + 1e-9) << system;
}

std::string row(const std::string& what, const std::string& law, const Error& e) {
  char text[200];
  std::snprintf(text, sizeof text, "| %s | `%s` | %.2f %% | %.1f %% | %d |\n", what.c_str(), law.c_str(), e.mean(),
                e.most, e.points);
  return text;
}

std::string page() {
  std::string text =
      "# Accuracy of the drag laws against lattice-Boltzmann data\n\nComputed by "
      "`tests/unit/closures/accuracy_test.cpp` from "
      "the tables in `tests/data/lbm`, every row: mean of the absolute relative errors, and the greatest. At "
      "voidage 1 the "
      "data are those of Turton and Levenspiel.\n\n| quantity | law | mean | greatest | points |\n| --- | "
      "--- | --- | --- | --- |\n";
  for (const char* law : {"cello", "vbk", "hkl", "di_felice", "gidaspow", "wen_yu", "ergun"})
    text += row("f, one size", law, of_one_size(law));
  for (const char* law : {"cello", "vbk_theory", "vbk_corrected"})
    text += row("alpha_j, two sizes", law, of_two_sizes(law).alpha);
  for (const char* law : {"cello", "vbk_theory", "vbk_corrected", "yin_sundaresan", "patwardhan_tien", "syamlal"})
    text += row("n_j, two sizes", law, of_two_sizes(law).net);
  for (const char* system : {"I", "II", "III", "IV"})
    text += row(std::string("n_j, ten sizes, system ") + system, "cello", of_system(system));
  const double cello = of_two_sizes("cello").net.mean(), theory = of_two_sizes("vbk_theory").net.mean(),
               corrected = of_two_sizes("vbk_corrected").net.mean();
  const auto compared = [&](double other) { return cello < other ? "better than" : "no better than"; };
  text += std::string("\nIn the force itself, n_j of two sizes, `cello` is ") + compared(theory) +
          " `vbk_theory` and " + compared(corrected) +
          " `vbk_corrected`. It gains as the voidage goes to 1, in the ratios alpha_j, in keeping the sum "
          "rule, and in cost. Laws for "
          "packed or for dilute beds alone (`ergun`, `wen_yu`) are shown over all voidages: their errors are "
          "those of using them "
          "outside their range.\n";
  return text;
}

TEST(Accuracy, PageIsWhatTheTablesGive) {
  const std::string path = std::string(POLYBED_SOURCE_DIR) + "/docs/record/accuracy.md";
  if (std::getenv("POLYBED_WRITE_DOCS") != nullptr) std::ofstream(path) << page();
  std::stringstream committed;
  committed << std::ifstream(path).rdbuf();
  EXPECT_EQ(committed.str(), page()) << "make it anew: POLYBED_WRITE_DOCS=1 build/tests/test_unit_closures";
}

}  // namespace
}  // namespace polybed::closures
