#include "core/numerics/integrator_vector.hpp"

#include <nvector/nvector_parallel.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/numerics/exact_sum.hpp"
#include "core/numerics/mpi.hpp"
#include "core/vectors.hpp"

namespace polybed::core {

namespace {

void linear_sum_of(double a, const double* x, double b, const double* y, double* z, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) z[i] = a * x[i] + b * y[i];
}

void add_three(const double* c, const double* x, const double* y, const double* w, double* z, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) z[i] = ((z[i] + c[0] * x[i]) + c[1] * y[i]) + c[2] * w[i];
}

void scale_of(double c, const double* x, double* z, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) z[i] = c * x[i];
}

void product_of(const double* x, const double* y, double* z, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) z[i] = x[i] * y[i];
}

void ratio_of(const double* x, const double* y, double* z, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) z[i] = x[i] / y[i];
}

void inverse_of(const double* x, double* z, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) z[i] = 1 / x[i];
}

void magnitude_of(const double* x, double* z, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) z[i] = std::abs(x[i]);
}

void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
  const std::span<double> to = entries(z);
  in_vectors<linear_sum_of>(a, entries(x).data(), b, entries(y).data(), to.data(), to.size());
}

void set_to(double c, N_Vector z) { std::fill(entries(z).begin(), entries(z).end(), c); }

void scale(double c, N_Vector x, N_Vector z) {
  in_vectors<scale_of>(c, entries(x).data(), entries(z).data(), entries(z).size());
}

/// z = sum c_k x_k; z can be x_0. Adds three terms per pass, in blocks that stay in the cache.
int linear_combination(int count, double* c, N_Vector* x, N_Vector z) {
  constexpr std::size_t block = 2048;
  const std::span<double> to = entries(z);
  for (std::size_t begin = 0; begin < to.size(); begin += block) {
    const std::size_t n = std::min(block, to.size() - begin);
    double* out = to.data() + begin;
    const auto term = [&](int k) { return entries(x[k]).data() + begin; };
    if (count == 1) {
      in_vectors<scale_of>(c[0], term(0), out, n);
      continue;
    }
    in_vectors<linear_sum_of>(c[0], term(0), c[1], term(1), out, n);
    int k = 2;
    for (; k + 3 <= count; k += 3) in_vectors<add_three>(c + k, term(k), term(k + 1), term(k + 2), out, n);
    for (; k < count; ++k) in_vectors<linear_sum_of>(1.0, out, c[k], term(k), out, n);
  }
  return 0;
}

void product(N_Vector x, N_Vector y, N_Vector z) {
  in_vectors<product_of>(entries(x).data(), entries(y).data(), entries(z).data(), entries(z).size());
}

void ratio(N_Vector x, N_Vector y, N_Vector z) {
  in_vectors<ratio_of>(entries(x).data(), entries(y).data(), entries(z).data(), entries(z).size());
}

void inverse(N_Vector x, N_Vector z) {
  in_vectors<inverse_of>(entries(x).data(), entries(z).data(), entries(z).size());
}

void magnitude(N_Vector x, N_Vector z) {
  in_vectors<magnitude_of>(entries(x).data(), entries(z).data(), entries(z).size());
}

const double* constant(N_Vector x) { return entries(x).data(); }

/// Sum over the entries of the whole vector.
template <class Term, class... More>
double sum_over(N_Vector x, More... more) {
  const MPI_Comm all = N_VGetVectorID(x) == SUNDIALS_NVEC_PARALLEL ? NV_COMM_P(x) : MPI_COMM_SELF;
  return exact_sum<Term>(all, std::size_t(N_VGetLength(x)), entries(x).size(), constant(x), constant(more)...);
}

double dot_product(N_Vector x, N_Vector y) { return sum_over<exact::Product>(x, y); }

double wrms_norm(N_Vector x, N_Vector w) {
  return std::sqrt(sum_over<exact::WeightedSquare>(x, w) / double(N_VGetLength(x)));
}

double wrms_norm_mask(N_Vector x, N_Vector w, N_Vector mask) {
  return std::sqrt(sum_over<exact::MaskedSquare>(x, w, mask) / double(N_VGetLength(x)));
}

N_Vector new_vector(std::size_t size, const Ranks* ranks, SUNContext context) {
  if (ranks == nullptr) return N_VNew_Serial(sunindextype(size), context);
  const MPI_Comm all = communicator(ranks);
  long long part = static_cast<long long>(size), sum = 0;
  check_mpi(MPI_Allreduce(&part, &sum, 1, MPI_LONG_LONG, MPI_SUM, all), "MPI_Allreduce");
  return N_VNew_Parallel(all, sunindextype(size), sunindextype(sum), context);
}

}  // namespace

Vector::Vector(std::size_t size, const Ranks* ranks, SUNContext context) : vector_(new_vector(size, ranks, context)) {
  if (vector_ == nullptr) throw NumericsError("no memory for the state");
  vector_->ops->nvlinearsum = linear_sum;
  vector_->ops->nvconst = set_to;
  vector_->ops->nvscale = scale;
  vector_->ops->nvlinearcombination = linear_combination;
  vector_->ops->nvprod = product;
  vector_->ops->nvdiv = ratio;
  vector_->ops->nvinv = inverse;
  vector_->ops->nvabs = magnitude;
  vector_->ops->nvdotprod = dot_product;
  vector_->ops->nvwrmsnorm = wrms_norm;
  vector_->ops->nvwrmsnormmask = wrms_norm_mask;
  N_VConst(0, vector_);
}

std::span<double> Vector::span() const { return entries(vector_); }

void Vector::assign(std::span<const double> values) const { std::copy(values.begin(), values.end(), span().begin()); }

std::span<double> entries(N_Vector v) {
  const bool parallel = N_VGetVectorID(v) == SUNDIALS_NVEC_PARALLEL;
  return {N_VGetArrayPointer(v), std::size_t(parallel ? NV_LOCLENGTH_P(v) : N_VGetLength(v))};
}

}  // namespace polybed::core
