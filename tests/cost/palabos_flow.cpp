// Flow by Palabos through the boxes of lbm_benchmark.cpp: site updates a second, and the drag on a sphere of a simple
// cubic array, by which both programs are seen to solve the same problem. Built and run by lbm_peers.py.
#include <palabos3D.h>
#include <palabos3D.hh>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "lbm_boxes.hpp"

using Real = PRECISION;
#define LATTICE plb::descriptors::ForcedD3Q19Descriptor

namespace {

using Lattice = plb::MultiBlockLattice3D<Real, LATTICE>;

struct Sphere {
  double centre[3], radius;
};

/// Whether a site is in a sphere, the box being periodic.
class Covered : public plb::DomainFunctional3D {
 public:
  Covered(std::vector<char> covered, int edge) : covered_(std::move(covered)), edge_(edge) {}
  bool operator()(plb::plint x, plb::plint y, plb::plint z) const override {
    const auto wrapped = [&](plb::plint n) { return std::size_t((n + edge_) % edge_); };
    return covered_[(wrapped(x) * std::size_t(edge_) + wrapped(y)) * std::size_t(edge_) + wrapped(z)] != 0;
  }
  Covered* clone() const override { return new Covered(*this); }

 private:
  std::vector<char> covered_;
  plb::plint edge_;
};

std::vector<char> sites_in(const std::vector<Sphere>& all, int edge) {
  std::vector<char> covered(std::size_t(edge) * edge * edge, 0);
  for (const Sphere& s : all) {
    const int reach = int(s.radius) + 2;
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j)
        for (int k = -reach; k <= reach; ++k) {
          const int at[3] = {int(s.centre[0]) + i, int(s.centre[1]) + j, int(s.centre[2]) + k};
          double square = 0;
          std::size_t site = 0;
          for (int a = 0; a < 3; ++a) {
            square += (at[a] - s.centre[a]) * (at[a] - s.centre[a]);
            site = site * std::size_t(edge) + std::size_t((at[a] % edge + edge) % edge);
          }
          if (square < s.radius * s.radius) covered[site] = 1;
        }
  }
  return covered;
}

/// A box at rest under a force on each site; tau = 1, a viscosity of 1/6.
Lattice make(const std::vector<char>& covered, int edge, Real force) {
  Lattice lattice(edge, edge, edge, new plb::GuoExternalForceBGKdynamics<Real, LATTICE>(Real(1)));
  lattice.periodicity().toggleAll(true);
  plb::defineDynamics(lattice, lattice.getBoundingBox(), new Covered(covered, edge),
                      new plb::BounceBack<Real, LATTICE>(Real(1)));
  plb::setExternalVector(lattice, lattice.getBoundingBox(), LATTICE<Real>::ExternalField::forceBeginsAt,
                         plb::Array<Real, 3>(force, 0, 0));
  plb::initializeAtEquilibrium(lattice, lattice.getBoundingBox(), Real(1), plb::Array<Real, 3>(0, 0, 0));
  lattice.initialize();
  return lattice;
}

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

double rate(int edge, double solids) {
  Lattice lattice = make(sites_in(jittered_spheres<Sphere>(edge, solids), edge), edge, Real(1e-6));
  const double sites = double(edge) * edge * edge;
  const int steps = std::max(4, int(8e6 / sites));
  lattice.collideAndStream();
  const double begin = processor_seconds();
  for (int n = 0; n < steps; ++n) lattice.collideAndStream();
  return steps * sites / (processor_seconds() - begin);
}

/// Net force over that of Stokes on a sphere of a simple cubic array, solids fraction 0.125, 18 sites an edge.
double cubic_drag() {
  constexpr int edge = 18, steps = 4000;
  const double radius = edge * std::cbrt(3 * 0.125 / (4 * M_PI)), force = 1e-6;
  const std::vector<char> covered = sites_in({{{edge / 2.0, edge / 2.0, edge / 2.0}, radius}}, edge);
  double fluid = 0, sum = 0;
  Lattice lattice = make(covered, edge, Real(force));
  for (int n = 0; n < steps; ++n) lattice.collideAndStream();
  for (int i = 0; i < edge; ++i)
    for (int j = 0; j < edge; ++j)
      for (int k = 0; k < edge; ++k) {
        if (covered[(std::size_t(i) * edge + std::size_t(j)) * edge + std::size_t(k)] != 0) continue;
        plb::Array<Real, 3> velocity;
        lattice.get(i, j, k).computeVelocity(velocity);
        sum += double(velocity[0]);
        ++fluid;
      }
  const double sites = double(edge) * edge * edge, speed = sum / sites, viscosity = 1.0 / 6;
  return force * sites / (6 * M_PI * viscosity * radius * speed);
}

}  // namespace

int main(int count, char** words) {
  plb::plbInit(&count, &words);
  const int edge = std::atoi(words[1]);
  for (const double solids : {0.0, 0.1, 0.5}) std::printf("%g %g\n", solids, rate(edge, solids));
  std::printf("drag %g\n", cubic_drag());
}
