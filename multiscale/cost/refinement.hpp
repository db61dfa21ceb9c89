// What a sequence of grids says of the grid that was not computed: order, limit and the grid convergence index.
#pragma once

#include <optional>
#include <string>

namespace polybed::multiscale {

/// One quantity on three grids of a constant ratio.
struct GridSequence {
  double coarse = 0, medium = 0, fine = 0;  ///< f3, f2, f1
  double ratio = 2;                         ///< r, of the spacings, > 1
  double formal_order = 2;                  ///< p_formal of the scheme
};

/// What follows from it. Without an index the value is the finest one and the band is what the values scatter by.
struct Refined {
  std::optional<double> order;                     ///< p; empty if the sequence does not fall into line
  double safety = 0;                               ///< F_s
  double limit = 0;                                ///< Richardson's value, or that of the finest grid
  double band = 0;                                 ///< half-width about the limit
  std::optional<double> fine_index, coarse_index;  ///< GCI of grids 1 and 2, and of 2 and 3, relative
  std::optional<double> asymptotic;                ///< GCI_12 r^p/GCI_23: 1 in the asymptotic range
  std::string note;                                ///< why there is no index, or why the safety is large; else empty
};

/// Observed order p = ln((f3 - f2)/(f2 - f1))/ln r, Richardson's limit f1 + (f1 - f2)/(r^p - 1) and
/// GCI = F_s |f1 - f2|/(|f1| (r^p - 1)) (Roache 1994, J. Fluids Eng. 116, 405; cost.md, section 5).
/// F_s = 1.25 where p_formal/2 <= p <= p_formal + 0.5; monotone otherwise: 3 with the smaller of p and p_formal.
/// Not monotone, or differences that do not shrink: no index; the band is three times half the range of the values.
/// Throws std::invalid_argument for r < 1.3, where rounding and noise are amplified beyond use.
[[nodiscard]] Refined refine(const GridSequence& grids);

}  // namespace polybed::multiscale
