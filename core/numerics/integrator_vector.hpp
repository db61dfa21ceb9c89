// The vectors of SUNDIALS: serial ones, and parallel ones for a column on several ranks. The sums over entries are
// written so that the compiler vectorises them; the library's own take a quarter of a run.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <span>

#include "core/numerics/ranks.hpp"

namespace polybed::core {

/// A vector that owns this rank's entries. Clones made by the library use the same operations.
class Vector {
 public:
  /// \param size   of this rank's part  \param ranks  null: there are no other parts
  /// Throws NumericsError if there is no memory.
  Vector(std::size_t size, const Ranks* ranks, SUNContext context);
  ~Vector() { N_VDestroy(vector_); }
  Vector(const Vector&) = delete;
  Vector& operator=(const Vector&) = delete;
  operator N_Vector() const { return vector_; }
  [[nodiscard]] std::span<double> span() const;
  void assign(std::span<const double> values) const;

 private:
  N_Vector vector_;
};

/// This rank's entries of a vector from the library.
[[nodiscard]] std::span<double> entries(N_Vector v);

}  // namespace polybed::core
