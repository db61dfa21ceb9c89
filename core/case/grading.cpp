#include "core/case/grading.hpp"

#include <algorithm>
#include <cmath>

namespace polybed::core {

std::vector<double> graded_layers(double height, int cells, double above, double ratio) {
  const double even = height / cells;
  const int fine = std::min(cells, int(std::ceil(above / even * (1 - 1e-12))));
  const double left = (cells - fine) * even;
  const auto grown = [&](int count, double factor) {
    double sum = 0, layer = even;
    for (int n = 0; n < count; ++n) sum += layer *= factor;
    return sum;
  };
  int count = 0;
  double sum = 0, layer = even;
  for (; sum < left * (1 - 1e-12); ++count) sum += layer *= ratio;
  double low = 1, high = ratio;
  for (int n = 0; n < 100; ++n) {
    const double factor = 0.5 * (low + high);
    (grown(count, factor) < left ? low : high) = factor;
  }
  std::vector<double> layers(std::size_t(fine), even);
  layer = even;
  for (int n = 0; n < count; ++n) layers.push_back(layer *= high);
  return layers;
}

std::vector<double> graded_widths(double width, int cells, double ratio) {
  std::vector<double> widths;
  double sum = 0;
  for (int n = 0; n < cells; ++n) sum += widths.emplace_back(std::pow(ratio, std::min(n, cells - 1 - n)));
  for (double& one : widths) one *= width / sum;
  return widths;
}

}  // namespace polybed::core
