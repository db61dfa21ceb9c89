#include "closures/size_classes.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstddef>

namespace polybed::closures {

namespace {

using Eigen::Index;
using Vector = Eigen::VectorXd;

/// A Gauss quadrature: nodes in increasing order, weights that sum to 1.
struct Quadrature {
  Vector node, weight;
};

/// Golub and Welsch: the nodes are the eigenvalues of the tridiagonal matrix of the recurrence, the weights the squares
/// of the first components of its eigenvectors.
Quadrature golub_welsch(const Vector& diagonal, const Vector& beside) {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside, Eigen::ComputeEigenvectors);
  return {solver.eigenvalues(), solver.eigenvectors().row(0).transpose().cwiseAbs2()};
}

/// Nodes and weights on [-1, 1].
Quadrature gauss_legendre(Index count) {
  Vector beside(count - 1);
  for (Index n = 1; n < count; ++n) beside[n - 1] = double(n) / std::sqrt(4.0 * double(n * n) - 1);
  return golub_welsch(Vector::Zero(count), beside);
}

/// The Gauss quadrature with `count` nodes for a discrete measure with more points than that: Lanczos with full
/// reorthogonalisation, which keeps the coefficients accurate to round-off.
Quadrature gauss_of(const Vector& point, const Vector& weight, Index count) {
  Eigen::MatrixXd basis(point.size(), count);
  Vector diagonal(count), beside(count - 1);
  Vector next = weight.cwiseSqrt();
  for (Index n = 0; n < count; ++n) {
    const double length = next.norm();
    if (n > 0) beside[n - 1] = length;
    basis.col(n) = next / length;
    next = point.cwiseProduct(basis.col(n));
    diagonal[n] = basis.col(n).dot(next);
    const auto found = basis.leftCols(n + 1);
    for (int twice = 0; twice < 2; ++twice) next -= found * (found.transpose() * next);
  }
  return golub_welsch(diagonal, beside);
}

/// Classes in units of `unit` from the quadrature of X D^-N, with total weight `moment`, M_-N in that unit.
std::vector<SizeClass> classes_of(const Quadrature& quadrature, double moment, double unit) {
  std::vector<SizeClass> classes;
  for (Index n = 0; n < quadrature.node.size(); ++n) {
    const double node = quadrature.node[n];
    classes.push_back({unit * node, moment * quadrature.weight[n] * std::pow(node, double(quadrature.node.size()))});
  }
  return classes;
}

}  // namespace

double lognormal_moment(double median, double deviation, double k) {
  return std::pow(median, k) * std::exp(0.5 * k * k * deviation * deviation);
}

double sieve_moment(std::span<const double> opening, std::span<const double> share, double k) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < opening.size(); ++i) {
    const double width = std::log(opening[i + 1] / opening[i]);
    // (b^k - a^k)/(k ln(b/a)), the mean of D^k over ln D
    sum += share[i] * std::pow(opening[i], k) * (k == 0 ? 1 : std::expm1(k * width) / (k * width));
  }
  return sum;
}

std::vector<SizeClass> lognormal_classes(double median, double deviation, int count) {
  const double square = deviation * deviation, q = std::exp(-square);
  // In units of the median of X D^-N, which is also log-normal: median q^N.
  Vector diagonal(count), beside(count - 1);
  for (int n = 0; n < count; ++n) {
    diagonal[n] = (1 + q * -std::expm1(-n * square)) * std::pow(q, -2 * n - 0.5);
    if (n > 0) beside[n - 1] = std::sqrt(-std::expm1(-n * square)) * std::pow(q, 1 - 2 * n);
  }
  const double unit = std::pow(q, count);
  return classes_of(golub_welsch(diagonal, beside), lognormal_moment(1 / unit, deviation, -count), median * unit);
}

std::vector<SizeClass> sieve_classes(std::span<const double> opening, std::span<const double> share, int count) {
  const double unit = 1 / sieve_moment(opening, share, -1);
  const Quadrature fine = gauss_legendre(24 + count);
  const Index per_interval = fine.node.size();
  Vector point(per_interval * Index(opening.size() - 1)), weight(point.size());
  for (std::size_t i = 0; i + 1 < opening.size(); ++i)
    for (Index n = 0; n < per_interval; ++n) {
      const Index at = Index(i) * per_interval + n;
      point[at] = opening[i] / unit * std::pow(opening[i + 1] / opening[i], 0.5 * (1 + fine.node[n]));
      weight[at] = share[i] * fine.weight[n] * std::pow(point[at], -count);
    }
  return classes_of(gauss_of(point, weight, count), weight.sum(), unit);
}

}  // namespace polybed::closures
