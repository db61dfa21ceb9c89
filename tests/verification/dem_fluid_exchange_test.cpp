// What drag takes from the fluid is what it gives to the particles, for any number of their steps to one of the fluid;
// and a slip that decays as it should, or is gone after a step that is far too long for it.
#include <Eigen/Eigenvalues>
#include <unsupported/Eigen/MatrixFunctions>

#include "core/numerics/random.hpp"
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

/// Two species at random places, away from each other and from bottom and top, moving at random.
core::Scene two_species(int every, const std::string& added_mass) {
  core::Scene scene = wet_box(0.5e-3, 2500, water, {12e-3, 12e-3, 12e-3}, {4, 4, 4});
  scene.species.push_back(sphere("b", 0.4e-3, {1e6, 0.25, 1200}));
  scene.column.sides = core::Boundary::periodic;
  scene.effects["drag"] = "cello";
  if (!added_mass.empty()) scene.effects["added_mass"] = added_mass;
  scene.dem.fluid_every = every;
  scene.dem.fixed_step = 1.6e-2 / every;  // about a relaxation time in all
  scene.dem.greatest_speed = 0.01;
  return scene;
}

std::vector<Bead> moving() {
  std::vector<Bead> beads = cubic_lattice("a", 1.5e-3, {12e-3, 12e-3, 12e-3});
  std::erase_if(beads, [](const Bead& b) { return b.x[1] < 3e-3 || b.x[1] > 9e-3; });
  for (std::uint64_t n = 0; n < beads.size(); ++n) {
    if (n % 2 == 1) beads[n].species = "b";
    for (std::size_t k = 0; k < 3; ++k) {
      beads[n].x[k] += 0.3e-3 * (core::uniform(3, k, n) - 0.5);
      beads[n].v[k] = 2e-3 * (core::uniform(4, k, n) - 0.5);
    }
  }
  return beads;
}

/// eps on faces from the particles' places alone.
core::FaceField voidage_on_faces(const dem::Model& model) {
  const core::Grid& grid = model.coupling()->flow().grid();
  core::FaceField eps = core::make_face_field(grid, 1);
  const dem::Weights weights(grid);
  for (const dem::Place& p : model.particles().place)
    for (int axis = 0; axis < 3; ++axis)
      dem::for_each_face(3, weights(p.x), axis, [&](std::size_t at, double w) {
        eps[std::size_t(axis)][at] -= w * 4.0 / 3 * pi * std::pow(p.radius, 3) / grid.cell_volume();
      });
  return eps;
}

// Without gravity, contacts and viscous stress, from a pressure of 0, over one step of the fluid:
//   particles: sum m dU_p = I - sum V dt dG, so I by drag is their gain and V dt dG;
//   fluid:     sum psi eps rho_f (dU + dt (U.grad)U) = -I - sum psi eps dt dG.
void check_exchange(int every, const std::string& added_mass) {
  Beads beads(two_species(every, added_mass), moving());
  const dem::Model& model = beads.model;
  std::vector<dem::Motion> before(model.particles().owned);
  for (std::size_t i = 0; i < before.size(); ++i)
    before[std::size_t(model.particles().id[i])] = model.particles().motion[i];
  beads.steps(every);
  ASSERT_EQ(model.coupling()->steps(), 1U);
  const fluid::Flow& flow = model.coupling()->flow();
  const core::Grid& grid = flow.grid();
  const double dt = every * beads.dt();
  const dem::Gather gather(grid, {1e-3});
  dem::Vector gain{}, loss{}, scale{};
  for (std::size_t i = 0; i < before.size(); ++i) {
    const dem::Motion& now = model.particles().motion[i];
    const dem::Vector& x = model.particles().place[i].x;
    const dem::Vector pushed = gather.vector(gather.lines(x), flow.gradient_change());
    for (std::size_t k = 0; k < 3; ++k) {
      const double m = 1 / now.inverse_mass, volume = 4.0 / 3 * pi * std::pow(model.particles().place[i].radius, 3);
      const double impulse =
          m * (now.v[k] - before[std::size_t(model.particles().id[i])].v[k]) + volume * dt * pushed[k];
      gain[k] += impulse;
      scale[k] += std::abs(impulse);
    }
  }
  const core::FaceField eps = voidage_on_faces(model);
  for (int axis = 0; axis < 3; ++axis)
    core::for_each_row(grid, flow.boundaries().moving_faces(axis, true), [&](core::Index begin, core::Index end) {
      const auto a = std::size_t(axis);
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
        loss[a] -= grid.cell_volume() * eps[a][c] *
                   (water.density * (flow.velocity_change()[a][c] + flow.convected()[a][c]) +
                    dt * flow.gradient_change()[a][c]);
    });
  for (std::size_t k = 0; k < 3; ++k)
    // Whole units of 2^-62 of 64 times the momentum of all at the greatest speed: 1.4e-13 of the impulses at most.
    compare(fmt::format("{} steps, {}, axis {}", every, added_mass, k), gain[k], loss[k], 1e-12, scale[k]);
}

TEST(DemExchange, LosesNothingBetweenParticlesAndFluid) {
  for (const int every : {1, 7, 16, 1000}) check_exchange(every, "");
}

TEST(DemExchange, LosesNothingWithAddedMass) {
  for (const int every : {1, 7, 16, 1000}) check_exchange(every, "zuber");
}

/// An even suspension in a column with joined sides, all particles of a species at one speed along x: on a lattice of
/// one particle in each cell (of each species), so that all fields stay even as they move.
struct Relaxation {
  core::Scene scene;
  std::vector<Bead> beads;
  static constexpr double spacing = 2e-3;

  Relaxation(const std::vector<core::Species>& species, const std::vector<double>& speed) {
    scene = wet_box(species[0].diameter, species[0].density, water, {8e-3, 6e-3, 8e-3}, {4, 3, 4});
    scene.species = species;
    scene.column.sides = core::Boundary::periodic;
    scene.effects["drag"] = "stokes";
    for (std::size_t j = 0; j < species.size(); ++j) {
      std::vector<Bead> more = cubic_lattice(species[j].name, spacing, scene.column.size, {speed[j], 0, 0});
      // Species on different rows of height would be uneven; along z nothing moves.
      for (Bead& b : more) b.x[2] += (double(j) - 0.5 * double(species.size() - 1)) * 0.8e-3;
      beads.insert(beads.end(), more.begin(), more.end());
    }
  }
  [[nodiscard]] double fraction(std::size_t j) const {
    return pi / 6 * std::pow(scene.species[j].diameter / spacing, 3);
  }
  [[nodiscard]] double voidage() const {
    double eps = 1;
    for (std::size_t j = 0; j < scene.species.size(); ++j) eps -= fraction(j);
    return eps;
  }
  /// B_j: drag per volume over the slip U_f - U_j, kg/(m3 s); f = 1.
  [[nodiscard]] double exchange(std::size_t j) const {
    const double d = scene.species[j].diameter;
    return 3 * pi * water.viscosity * d * voidage() / std::pow(spacing, 3);
  }
  /// Velocities along x after a time: of the fluid and of every species. Matrix exponential.
  [[nodiscard]] Eigen::VectorXd exact(const Eigen::VectorXd& start, double time) const {
    const auto n = Eigen::Index(scene.species.size()) + 1;
    Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index j = 1; j < n; ++j) {
      const auto s = std::size_t(j - 1);
      const double b = exchange(s), solid = fraction(s) * scene.species[s].density, liquid = voidage() * water.density;
      rate(0, 0) -= b / liquid;
      rate(0, j) += b / liquid;
      rate(j, j) -= b / solid;
      rate(j, 0) += b / solid;
    }
    return (rate * time).exp() * start;
  }
  [[nodiscard]] static Eigen::VectorXd velocities(const Beads& run, std::size_t species) {
    Eigen::VectorXd u(Eigen::Index(species) + 1);
    const fluid::Flow& flow = run.model.coupling()->flow();
    u[0] = flow.state().velocity[0][std::size_t(flow.grid().index(1, 1, 1))];
    const dem::Particles& p = run.model.particles();
    for (std::size_t i = 0; i < p.owned; ++i) u[p.species[i] + 1] = p.motion[i].v[0];
    return u;
  }
};

std::vector<core::Species> one_species() { return {sphere("a", 0.5e-3, {1e6, 0.25, 2500})}; }
std::vector<core::Species> three_phases() {
  return {sphere("a", 0.35e-3, {1e6, 0.25, 2500}), sphere("b", 0.3e-3, {1e6, 0.25, 1100})};
}

/// Greatest error of all phases at some times, over the slip at the start. \param steps  of the fluid in a relaxation time
double error_of(const std::vector<core::Species>& species, const std::vector<double>& speed, int steps, int every) {
  Relaxation set(species, speed);
  const double tau =
      1 / (set.exchange(0) * (1 / (set.voidage() * water.density) + 1 / (set.fraction(0) * species[0].density)));
  set.scene.dem.fluid_every = every;
  set.scene.dem.fixed_step = tau / steps / every;
  Beads run(set.scene, set.beads);
  const Eigen::VectorXd start = Relaxation::velocities(run, species.size());
  double worst = 0;
  for (const double time : {0.5, 1.0, 3.0}) {
    run.until(time * tau);
    worst = std::max(
        worst, (Relaxation::velocities(run, species.size()) - set.exact(start, time * tau)).cwiseAbs().maxCoeff());
  }
  return worst / (start.maxCoeff() - start.minCoeff());
}

// slip ~ exp(-B t (1/(eps rho_f) + 1/(phi rho_p))): the exchange between steps of the fluid is of first order in them.
TEST(DemExchange, SlipDecaysAsItShould) {
  const std::vector<core::Species> species = one_species();
  const double coarse = error_of(species, {0.02}, 20, 4), fine = error_of(species, {0.02}, 200, 4);
  RecordProperty("error at 20 and 200 steps of the fluid", fmt::format("{:.2g} {:.2g}", coarse, fine));
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log10(coarse / fine), 1, 0.1);  // order
}

TEST(DemExchange, SlipsOfTwoSpeciesDecayAsTheMatrixExponential) {
  const double coarse = error_of(three_phases(), {0.02, -0.01}, 20, 4),
               fine = error_of(three_phases(), {0.02, -0.01}, 200, 4);
  RecordProperty("error at 20 and 200 steps of the fluid", fmt::format("{:.2g} {:.2g}", coarse, fine));
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log10(coarse / fine), 1, 0.1);
}

// One step of the fluid as long as a thousand relaxation times: no slip is left, and the momentum is where it belongs.
TEST(DemExchange, StepsOfAThousandRelaxationTimesEndWhereTheyShould) {
  for (const int every : {1, 16, 1000}) {
    Relaxation set(three_phases(), {1e-5, -0.5e-5});
    const double tau = set.fraction(0) * 2500 / set.exchange(0);
    set.scene.dem.fluid_every = every;
    set.scene.dem.fixed_step = 1000 * tau / every;
    set.scene.dem.greatest_speed = 1e-4;
    Beads run(set.scene, set.beads);
    double momentum = 0, mass = set.voidage() * water.density;
    for (std::size_t j = 0; j < 2; ++j) {
      const double solid = set.fraction(j) * set.scene.species[j].density;
      momentum += solid * (j == 0 ? 1e-5 : -0.5e-5);
      mass += solid;
    }
    for (int n = 1; n <= 5; ++n) {
      run.steps(every);
      const Eigen::VectorXd u = Relaxation::velocities(run, 2);
      for (Eigen::Index j = 0; j < 3; ++j) {
        EXPECT_LE(std::abs(u[j]), 1e-5 * (1 + 1e-12))
            << every << " step " << n;  // never beyond the greatest at the start
        if (n == 5) compare(fmt::format("{} steps, phase {}", every, j), u[j], momentum / mass, 1e-6, 1e-5);
      }
    }
  }
}

// All that is in the column, in steps of any length: to round-off and the whole units of the sums.
TEST(DemExchange, KeepsTheMomentumOfTheColumn) {
  Relaxation set(three_phases(), {0.02, -0.01});
  set.scene.effects["drag"] = "cello";
  set.scene.dem.fixed_step = 1e-4;
  set.scene.dem.fluid_every = 7;
  Beads run(set.scene, set.beads);
  const auto momentum = [&] {
    const Eigen::VectorXd u = Relaxation::velocities(run, 2);
    return set.voidage() * water.density * u[0] + set.fraction(0) * 2500 * u[1] + set.fraction(1) * 1100 * u[2];
  };
  const double before = momentum();
  run.steps(700);
  compare("momentum after 100 steps of the fluid, kg/(m2 s)", momentum(), before, 1e-12);
}

}  // namespace
}  // namespace polybed::scenes
