// The drag laws against the tables of the thesis and the reference points.
#include <gtest/gtest.h>

#include "../../data/table.hpp"
#include "closures/drag.hpp"

namespace polybed::closures {
namespace {

/// Net force over Stokes of species j: n_j = f_j + (1-eps) y_j^2 f_mean/eps, T(3.13)-(3.17).
double net_of_pure(double voidage, double f_pure, double poly_index, double f_mean) {
  return f_pure + (1 - voidage) * poly_index * poly_index * f_mean / voidage;
}

using test::Table;

double f_bare(const std::string& law, double eps, double re) {
  double f = 0, slope = 0;
  GuardCount count;
  drag_of_points(drag_law(law, Guard::off), {&eps, 1}, {&re, 1}, {&f, 1}, {&slope, 1}, count);
  return f;
}

void expect_relative(double value, double expected, double tolerance, const std::string& where) {
  if (std::isnan(expected)) return;
  EXPECT_LE(std::abs(value - expected), tolerance * std::abs(expected) + 1e-14)
      << where << ": " << value << " for " << expected;
}

TEST(DragTables, BareLawsAtReferencePoints) {
  // Twelve digits, computed apart from this code; 1e-10 leaves two for their rounding and ours.
  const Table table("lbm/ref_mono_points.csv");
  const std::map<std::string, std::string> column{
      {"cello", "f_NM"},    {"vbk", "f_VBK"},           {"hkl", "f_HKL"},         {"turton_levenspiel", "f_TL"},
      {"ergun", "f_Ergun"}, {"carman_kozeny", "f_CK5"}, {"wen_yu", "f_WenYu_SN"}, {"di_felice", "f_DiFelice_Dalla"}};
  ASSERT_GT(table.rows(), 50u);
  for (std::size_t n = 0; n < table.rows(); ++n) {
    const double eps = table.number(n, "eps"), re = table.number(n, "Re");
    for (const auto& [law, name] : column)
      expect_relative(f_bare(law, eps, re), table.number(n, name), 1e-10, law + " row " + std::to_string(n));
    if (re > 0) {
      expect_relative(24 / re * f_bare("schiller_naumann", 1, re), table.number(n, "Cd_SN"), 1e-10, "Cd_SN");
      expect_relative(24 / re * f_bare("dallavalle", 1, re), table.number(n, "Cd_Dalla"), 1e-10, "Cd_Dalla");
    }
  }
}

TEST(DragTables, PrintedAndRecomputedColumnsOfOneSize) {
  // Printed digits: 0.15 % (A-i), 0.5 % (A-ii, A-iii; VBK 0.8 %), the rounding of f and of the printed voidage.
  const std::map<std::string, std::string> laws{
      {"cello", "NM"}, {"vbk", "VBK"}, {"hkl", "HKL"}, {"turton_levenspiel", "TL"}};
  for (const std::string name : {"A_i", "A_ii", "A_iii"}) {
    const Table table("lbm/tab_" + name + ".csv");
    for (std::size_t n = 0; n < table.rows(); ++n)
      for (const auto& [law, short_name] : laws) {
        const double f = f_bare(law, table.number(n, "eps"), table.number(n, "Re"));
        const std::string where = name + " " + law + " row " + std::to_string(n);
        if (table.has("f_" + short_name + "_calc"))
          expect_relative(f, table.number(n, "f_" + short_name + "_calc"), 1e-5, where);
        if (law == "turton_levenspiel") continue;
        const double printed = name == "A_i" ? 1.5e-3 : law == "vbk" ? 8e-3 : 5e-3;
        expect_relative(f, table.number(n, "f_" + short_name), printed, where + " printed");
      }
  }
}

/// Everything that a row of ref_poly_points asks of one mixture.
struct TableMixture {
  double eps = 0, re = 0;
  std::vector<double> share, diameter;
  std::vector<std::size_t> rows;
};

std::vector<TableMixture> mixtures_of(const Table& table) {
  std::vector<TableMixture> list;
  std::string last;
  for (std::size_t n = 0; n < table.rows(); ++n) {
    if (table.text(n, "case") != last) list.push_back({table.number(n, "eps"), table.number(n, "Rebar"), {}, {}, {}});
    last = table.text(n, "case");
    list.back().share.push_back(table.number(n, "x"));
    list.back().diameter.push_back(table.number(n, "D"));
    list.back().rows.push_back(n);
  }
  return list;
}

TEST(DragTables, MixturesAtReferencePoints) {
  const Table table("lbm/ref_poly_points.csv");
  const auto bare = [](const std::string& name, const TableMixture& m, std::vector<double>& f) {
    const DragLaw law = drag_law(name, Guard::off);
    const double mean = sauter_diameter(m.share, m.diameter);
    std::vector<double> slip(m.share.size(), m.re / mean), slope(m.share.size());
    f.resize(m.share.size());
    drag_of_mixture(law, m.eps, m.share, m.diameter, slip, 1, 1, f, slope);
    return drag_of_mean(law, m.eps, m.re, m.share, m.diameter, f);
  };
  for (const TableMixture& m : mixtures_of(table)) {
    std::vector<double> cello, theory, corrected, yin;
    const double mean = sauter_diameter(m.share, m.diameter);
    const double f_mean = bare("cello", m, cello), f_vbk = bare("vbk_theory", m, theory);
    bare("vbk_corrected", m, corrected);
    bare("yin_sundaresan", m, yin);
    double average = 0;
    for (std::size_t j = 0; j < m.share.size(); ++j) average += m.share[j] * m.diameter[j];
    for (std::size_t j = 0; j < m.rows.size(); ++j) {
      const std::size_t n = m.rows[j];
      const std::string where = "row " + std::to_string(n);
      const double y = m.diameter[j] / mean;
      // The shares of the table have four digits and sum to 1 within 1e-4 for some mixtures: y is checked, not assumed.
      expect_relative(y, table.number(n, "y"), 1e-10, where + " y");
      expect_relative(poly_index_mean(m.share, m.diameter), table.number(n, "ym"), 1e-10, where + " ym");
      expect_relative(f_mean, table.number(n, "f_mono_NM"), 1e-10, where + " f");
      expect_relative(cello[j], table.number(n, "f_j_NM"), 1e-10, where + " f_j");
      expect_relative(cello[j] / f_mean, table.number(n, "Omega_NM"), 1e-10, where + " Omega");
      expect_relative(alpha_of_omega(m.eps, cello[j] / f_mean, y), table.number(n, "alpha_NM"), 1e-10,
                      where + " alpha");
      expect_relative(alpha_of_omega(m.eps, theory[j] / f_vbk, y), table.number(n, "alpha_VBK_theo"), 1e-10,
                      where + " theory");
      expect_relative(alpha_of_omega(m.eps, corrected[j] / f_vbk, y), table.number(n, "alpha_VBK_corr"), 1e-10,
                      where + " corrected");
      expect_relative(net_of_pure(m.eps, cello[j], y, f_mean), table.number(n, "n_j_NM"), 1e-10, where + " n_j");
      expect_relative(MixturePatwardhanTien::own_voidage(m.eps, m.diameter[j], average),
                      table.number(n, "eps_j_PatwardhanTien"), 1e-10, where + " eps_j");
      expect_relative(yin[j], table.number(n, "f_j_YinSund_NMbar"), 1e-10, where + " yin");
    }
  }
}

TEST(DragTables, PrintedMixturesOfTwoSizes) {
  for (const std::string name : {"A_iv", "A_v"}) {
    const Table table("lbm/tab_" + name + ".csv");
    for (std::size_t n = 0; n < table.rows(); ++n) {
      const double eps = table.number(n, "eps"), re = table.number(n, "Rebar"), x1 = table.number(n, "x1");
      const std::vector<double> share{x1, 1 - x1}, diameter{table.number(n, "D1_over_D2_used"), 1.0};
      const double mean = sauter_diameter(share, diameter);
      std::vector<double> f(2), slope(2), slip(2, re / mean);
      const DragLaw law = drag_law("cello", Guard::off);
      drag_of_mixture(law, eps, share, diameter, slip, 1, 1, f, slope);
      const double f_mean = drag_of_mean(law, eps, re, share, diameter, f);
      const std::string where = name + " row " + std::to_string(n);
      const double n1 = net_of_pure(eps, f[0], diameter[0] / mean, f_mean),
                   n2 = net_of_pure(eps, f[1], diameter[1] / mean, f_mean);
      expect_relative(f_mean / eps, table.number(n, "nbar_NM_calc"), 1e-5, where);
      expect_relative(n1, table.number(n, "n1_NM_calc"), 1e-5, where);
      expect_relative(n2, table.number(n, "n2_NM_calc"), 1e-5, where);
      // Printed with one decimal: half a unit and the rounding of the diameter ratio; n2 at Re > 0 is a known slip.
      const auto printed = [&](double value, const std::string& column) {
        const double expected = table.number(n, column);
        if (std::isnan(expected)) return;
        EXPECT_LE(std::abs(value - expected), 0.06 + 2e-3 * expected) << where << " " << column;
      };
      printed(f_mean / eps, "nbar_NM");
      printed(n1, "n1_NM");
      if (re == 0) printed(n2, "n2_NM");
    }
  }
}

TEST(DragTables, TenAndFourSizes) {
  for (const std::string name : {"B_i", "B_ii", "B_iii"}) {
    const Table table("lbm/tab_" + name + ".csv");
    for (std::size_t n = 0; n < table.rows(); ++n) {
      const double eps = table.number(n, "eps"), re = table.number(n, "Rebar"), y = table.number(n, "y_j");
      const double omega = y * (1 + cello_h(eps) * (y - 1) / table.number(n, "ym_used"));
      const double alpha = alpha_of_omega(eps, omega, y), mean = DragCello{}.bare(eps, re).f / eps;
      const std::string where = name + " row " + std::to_string(n);
      expect_relative(alpha, table.number(n, "alpha_NM_calc"), 1e-5, where);
      expect_relative(mean, table.number(n, "nbar_NM_calc"), 1e-5, where);
      expect_relative(alpha * mean, table.number(n, "n_j_NM_calc"), 1e-5, where);
    }
  }
}

}  // namespace
}  // namespace polybed::closures
