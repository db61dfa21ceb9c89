// A continuous size distribution as a few classes with the same moments, for mixture drag T(4.25)-(4.27).
//
// X(D) dD is the share of the solids' volume between D and D + dD, M_k = integral X D^k dD. The N classes are the nodes
// of the Gauss quadrature with the weight X(D) D^-N: they reproduce the 2N moments k = -N ... N-1 exactly, as sums x_j
// D_j^k over the classes. Every N thus keeps the volume (0) and the Sauter diameter 1/M_-1; N >= 2 keeps the mean
// polydispersity index y_m = M_1 M_-1 and M_-2, to which Stokes drag per mass is proportional; N >= 3 keeps the number
// of particles, 6 M_-3/pi per volume. As the moments are centred on 0, the classes do not crowd in either tail. All
// diameters and shares are positive.
#pragma once

#include <span>
#include <vector>

namespace polybed::closures {

/// One size that represents a part of a distribution.
struct SizeClass {
  double diameter;  ///< D_j, m
  double share;     ///< x_j, share of the distribution's volume; the shares sum to 1
};

/// Moment M_k of the log-normal distribution by volume: median^k exp(k^2 s^2/2). median > 0: by volume, m; s >= 0:
/// standard deviation of ln D.
[[nodiscard]] double lognormal_moment(double median, double deviation, double k);

/// Moment M_k of a sieve analysis. opening: rising, m; share[i] is retained on sieve i and passes sieve i + 1, evenly
/// over ln D between the two openings; the last sieve retains nothing.
[[nodiscard]] double sieve_moment(std::span<const double> opening, std::span<const double> share, double k);

/// Classes for a log-normal distribution, in increasing order of size: orthogonal polynomials of Stieltjes and Wigert
/// (Chihara 1978, VI.2), nodes after Golub and Welsch 1969. count 1 to 10; deviation 0: all diameters are the median.
[[nodiscard]] std::vector<SizeClass> lognormal_classes(double median, double deviation, int count);

/// Classes for a sieve analysis, in increasing order of size: recurrence coefficients from a fine Gauss-Legendre rule
/// in ln D by the Lanczos process (Gautschi 2004, 2.2.3). Moments to 1e-12 if neighbouring openings are within 1 : 30.
[[nodiscard]] std::vector<SizeClass> sieve_classes(std::span<const double> opening, std::span<const double> share,
                                                   int count);

}  // namespace polybed::closures
