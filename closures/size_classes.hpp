// A continuous distribution of sizes as a few classes that have its moments, for the drag of mixtures T(4.25)-(4.27).
//
// X(D) dD is the share of the solids' volume between D and D + dD, M_k = integral X D^k dD. N classes are the nodes of
// the Gauss quadrature with the weight X(D) D^-N: they have the 2N moments k = -N ... N-1 of the distribution exactly,
// the sums over the classes being sum x_j D_j^k. So every N keeps the volume (0) and the Sauter diameter 1/M_-1; N >= 2
// keeps the mean polydispersity index y_m = M_1 M_-1 and M_-2, to which Stokes drag per mass is proportional; N >= 3
// keeps the number of particles, 6 M_-3/pi per volume. Lying evenly around 0, they keep the classes from crowding in
// either tail. All diameters and shares are positive.
#pragma once

#include <span>
#include <vector>

namespace polybed::closures {

/// One size that stands for a part of a distribution.
struct SizeClass {
  double diameter;  ///< D_j, m
  double share;     ///< x_j of the volume of the distribution; the shares sum to 1
};

/// Moment M_k of the log-normal distribution of volume: median^k exp(k^2 s^2/2). median > 0: by volume, m; s >= 0:
/// standard deviation of ln D.
[[nodiscard]] double lognormal_moment(double median, double deviation, double k);

/// Moment M_k of a sieve analysis. opening: rising, m; share[i] is retained on sieve i and passes sieve i + 1, evenly
/// over ln D between the two openings; the last sieve retains nothing.
[[nodiscard]] double sieve_moment(std::span<const double> opening, std::span<const double> share, double k);

/// Classes of a log-normal distribution, in rising order of size: orthogonal polynomials of Stieltjes and Wigert
/// (Chihara 1978, VI.2), nodes after Golub and Welsch 1969. count 1 to 10; deviation 0: all diameters are the median.
[[nodiscard]] std::vector<SizeClass> lognormal_classes(double median, double deviation, int count);

/// Classes of a sieve analysis, in rising order of size: recurrence coefficients from a fine Gauss-Legendre rule in ln
/// D by the process of Lanczos (Gautschi 2004, 2.2.3). Moments to 1e-12 if neighbouring openings are within 1 : 30.
[[nodiscard]] std::vector<SizeClass> sieve_classes(std::span<const double> opening, std::span<const double> share,
                                                   int count);

}  // namespace polybed::closures
