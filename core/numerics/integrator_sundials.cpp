#include "core/numerics/integrator_sundials.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "core/error.hpp"
#include "core/numerics/exact_sum.hpp"

namespace polybed::core {

void require_success(int flag, const char* call) {
  if (flag < 0) throw NumericsError(fmt::format("{} failed with code {}", call, flag));
}

void keep_silent(int, const char*, const char*, char*, void*) {}

void report_error(std::span<const double> error, std::span<const double> weight, const Ranks* ranks,
                  StepReport& report) {
  for (std::size_t n = 0; n < error.size(); ++n) {
    const double weighted = std::abs(error[n] * weight[n]);
    if (weighted > report.worst_error) {
      report.worst_error = weighted;
      report.worst_entry = n;
    }
  }
  std::array<std::int64_t, 1> size{std::int64_t(error.size())};
  add_over_ranks(ranks, size);
  const double sum = exact_sum<exact::WeightedSquare>(communicator(ranks), std::size_t(size[0]), error.size(),
                                                      error.data(), weight.data());
  report.error_norm = std::sqrt(sum / double(size[0]));
}

std::string flag_name(char* (*name)(long int), int flag) {
  char* text = name(flag);
  std::string result = text;
  std::free(text);
  return result;
}

}  // namespace polybed::core
