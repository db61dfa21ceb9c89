// The vectors that SUNDIALS computes with: its serial ones, with the sums over entries written so that the compiler
// works on several entries at once. The library's own take a quarter of a run.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <span>

namespace polybed::core {

/// A serial vector that owns its entries; clones made by the library compute alike.
class Vector {
 public:
  /// Throws NumericsError if there is no memory.
  Vector(std::size_t size, SUNContext context);
  ~Vector() { N_VDestroy(vector_); }
  Vector(const Vector&) = delete;
  Vector& operator=(const Vector&) = delete;
  operator N_Vector() const { return vector_; }
  [[nodiscard]] std::span<double> span() const;
  void assign(std::span<const double> values) const;

 private:
  N_Vector vector_;
};

/// The entries of a vector that the library hands over.
[[nodiscard]] std::span<double> entries(N_Vector v);

}  // namespace polybed::core
