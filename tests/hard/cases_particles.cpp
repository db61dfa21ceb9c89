// Hard cases of dry particles: D1 to D8. D9 to D15 are in cases_boxes.cpp.
#include <algorithm>
#include <cmath>

#include "hard/cases.hpp"
#include "hard/dry_spheres.hpp"
#include "hard/grains.hpp"

namespace polybed::hard {

namespace {

/// D1: two spheres start half a diameter deep in each other. The product stops and names them; a textbook's step, fit
/// for a light touch, lets them fly apart with what the overlap holds.
void overlapping_start(Trial& trial) {
  core::Scene scene = dry_box(radius, glass, {0.02, 0.02, 0.02});
  const std::vector<Bead> beads{{"a", {0.01, 0.01, 0.01}}, {"a", {0.01 + radius, 0.01, 0.01}}};
  if (!trial.naive()) return stops_with_ids(trial, scene, beads, 10);
  scene.dem.fixed_step = own_step(scene, {beads[0]});
  const auto run = textbook::spheres(trial.treatment().naive, scene, beads);
  run->steps(2000);
  trial.measure("V5 energy over that expected", std::pow(speed(run->motion(0)) / *scene.dem.greatest_speed, 2), 1);
}

/// D2: a sphere rests on a linear floor; steps below the predicted limit leave it there, and the limit is that of the
/// linear analysis: a step 5 % beyond it does not. A case that gives more than half of it is warned. Damping ratios 0
/// to 0.8, both integrators.
void at_the_limit(Trial& trial) {
  for (const std::string integrator : {"thesis", "synchronised"})
    for (const double damping : {0.0, 0.2, 0.8}) {
      core::Scene scene = dry_box(radius, {1e6, 0.25, 2600}, {0.01, 0.01, 0.01});
      scene.effects["contact"] = "linear";
      scene.dem.normal_stiffness = 1000;
      scene.dem.tail = core::Tail::keep;
      scene.dem.integrator = core::choice_of<core::DemIntegrator>(integrator);
      core::set_restitution(scene, std::exp(-scenes::pi * damping / std::sqrt(1 - damping * damping)));
      scene.column.gravity = gravity;
      const double sag = scenes::mass_of(radius, 2600) * gravity / 1000;
      const std::vector<Bead> start{{"a", {0.005, radius - sag * (1 + 1e-6), 0.005}}};
      const Beads probe(scene, start);
      double predicted = 0;
      for (const dem::StepLimit& l : probe.model.limits().all)
        if (l.name == "damping of a and wall") predicted = l.dt / 0.2;
      const auto grows = [&](double step) {
        scene.dem.fixed_step = step;
        Beads run(scene, start);
        for (int n = 0; n < 300; ++n) {
          run.steps(1);
          if (!(std::abs(run.place(0).x[1] - radius + sag) < 1e-5 * sag)) return true;
        }
        return false;
      };
      trial.measure("V5 grows below the limit", grows(0.95 * predicted) ? 1 : 0, 0);
      trial.measure("stays beyond the limit", grows(1.05 * predicted) ? 0 : 1, 0);
      // What the case would be run with leaves a factor of five.
      trial.measure("own step over the limit", probe.dt() / predicted, 0.5);
      const auto warned = [&](double step) {
        scene.dem.fixed_step = step;
        return !Beads(scene, start).model.limits().warning.empty();
      };
      const double least = probe.model.limits().stability.dt;  // of all pairs
      trial.measure("V16 warned of more than half the limit", warned(0.51 * least) ? 0 : 1, 0);
      trial.measure("warned of less", warned(0.49 * least) ? 1 : 0, 0);
    }
}

/// D3: a sphere falls on the floor at 0.5 m/s, Young's modulus 1e7 to 2e11 Pa: the rebound is the restitution asked
/// for; one of 1e5 Pa, which would sink in by more than a twentieth of its diameter, is stopped. A textbook keeps the
/// step of the first.
void any_stiffness(Trial& trial) {
  const std::vector<Bead> start{{"a", {0.005, 1.0001 * radius, 0.005}, {0, -0.5, 0}}};
  if (!trial.naive()) {
    Beads soft(dry_box(radius, {1e5, 0.25, 2500}, {0.01, 0.01, 0.01}), start);
    bool stopped = false;
    try {
      soft.run_while([&] { return soft.motion(0).v[1] < 0; });
    } catch (const core::NumericsError& error) {
      stopped = names_particle_and_place(error.what());
    }
    trial.measure("V16 too soft a sphere is stopped and named", stopped ? 0 : 1, 0);
  }
  double step = 0;
  for (const double modulus : {1e7, 1e9, 2e11}) {
    core::Scene scene = dry_box(radius, {modulus, 0.25, 2500}, {0.01, 0.01, 0.01});
    if (step == 0) step = own_step(scene, start);
    with_run(trial, scene, start, step, [&](auto& run) {
      double depth = 0;
      for (int n = 0; n < 100'000 && (run.motion(0).v[1] < 0 || run.place(0).x[1] < radius); ++n) {
        run.steps(1);
        depth = std::max(depth, radius - run.place(0).x[1]);
      }
      trial.measure("rebound as asked for", std::abs(run.motion(0).v[1] / (0.9 * 0.5) - 1), 0.01);
      trial.measure("overlap over the diameter", depth / (2 * radius), 0.05);
    });
  }
}

/// D4: a small sphere lies on a large one that rests, size ratios 10 to 50, with friction and rolling friction: the
/// large one carries its weight.
void small_on_large(Trial& trial) {
  for (const double ratio : {10.0, 50.0}) {
    core::Scene scene = dry_box(ratio * 0.1e-3, glass, {0.02, 0.02, 0.02});
    scene.species.push_back(scenes::sphere("b", 0.1e-3, glass));
    scene.column.gravity = gravity;
    core::set_restitution(scene, 0.3);
    scene.effects["rolling"] = "epsd";
    scene.dem.rolling_friction = 0.01;
    scene.dem.greatest_speed = 0.05;
    const double large = ratio * 0.1e-3;
    Beads run(scene, {{"a", {0.01, 0.9999 * large, 0.01}}, {"b", {0.01, 2 * large + 0.99995 * 0.1e-3, 0.01}}});
    run.steps(std::llround(0.03 / run.dt()));
    const double weight = scenes::mass_of(0.1e-3, 2500) * gravity;
    trial.measure("force on the small one over its weight, less 1", std::abs(run.force(1)[1] / weight - 1), 0.01);
    trial.measure("V6 rest", speed(run.motion(1)), 1e-10);  // as everywhere
  }
}

/// D5: elastic grazing impacts of a pair: what leaves has not more energy than what came.
void grazing_impacts(Trial& trial) {
  core::Scene scene = dry_box(radius, glass, {0.02, 0.02, 0.02});
  core::set_restitution(scene, 1);
  core::set_friction(scene, 5);  // nothing slides: what the springs hold comes back
  scene.dem.steps_per_contact = 100;
  for (double angle = 0; angle < 1.5; angle += 0.1) {
    const double apart = 2 * radius * 1.0001;
    const std::vector<Bead> start{{"a", {0.01, 0.01, 0.01}, {0.5 * std::cos(angle), 0.5 * std::sin(angle), 0}},
                                  {"a", {0.01 + apart, 0.01, 0.01}}};
    with_run(trial, scene, start, own_step(scene, start), [&](auto& run) {
      const double before = kinetic(run.motion(0)) + kinetic(run.motion(1));
      bool touched = false;
      for (int n = 0; n < 20'000; ++n) {
        run.steps(1);
        const dem::Vector &a = run.place(0).x, &b = run.place(1).x;
        const bool touching = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < 2 * radius;
        if (touched && !touching) break;
        touched = touched || touching;
      }
      trial.measure("V5 energy gained", (kinetic(run.motion(0)) + kinetic(run.motion(1))) / before - 1, 1e-3);
    });
  }
}

/// D6: a sphere pressed into a corner of three walls: each pushes as if it were alone.
void corner_of_three(Trial& trial) {
  const core::Scene scene = dry_box(radius, glass, {0.01, 0.01, 0.01});
  const double k = 4.0 / 3 * 5e6 / (1 - 0.25 * 0.25) * std::sqrt(radius);
  const dem::Vector overlap{5e-6, 1e-5, 1.5e-5};
  const std::vector<Bead> start{{"a", {radius - overlap[0], radius - overlap[1], radius - overlap[2]}}};
  with_run(trial, scene, start, own_step(scene, start), [&](auto& run) {
    for (std::size_t d = 0; d < 3; ++d)
      trial.measure("force of each wall", std::abs(run.force(0)[d] / (k * std::pow(overlap[d], 1.5)) - 1), 1e-8);
  });
}

/// D7: a dense box is sheared: the ledger closes over many lists of pairs.
void dense_shear(Trial& trial) {
  core::Scene scene = dry_box(radius, {5e6, 0.25, 2500}, {6e-3, 6e-3, 6e-3});
  scene.column.sides = scene.column.ends = core::Boundary::periodic;
  scene.bed.start = {core::StartKind::random};
  scene.bed.particles = {247};  // a solids fraction of 0.60
  scene.column.shear_rate = 20;
  core::set_friction(scene, 0.5);
  core::Timers timers;
  dem::Model model(scene, timers);
  Grains grains(trial, model);
  grains.steps(3000);
  trial.report("lists", double(model.work().rebuilds));
}

/// D8: a sphere hangs between two walls by friction: it sags by no more than its springs give.
void hangs_by_friction(Trial& trial) {
  const double squeeze = 5e-6;
  core::Scene scene = dry_box(radius, glass, {2 * radius - 2 * squeeze, 0.02, 0.01});
  scene.column.gravity = gravity;
  scene.dem.greatest_speed = 0.01;
  const std::vector<Bead> start{{"a", {radius - squeeze, 0.01, 0.005}}};
  with_run(trial, scene, start, own_step(scene, start), [&](auto& run) {
    run.steps(20'000);
    const double shear = 4 * 5e6 / (1 - 0.0625) * 0.75 / 1.75 * std::sqrt(radius * squeeze);
    const double sag = scenes::mass_of(radius, 2500) * gravity / (2 * 2.0 / 3 * shear);  // the softer of the laws
    trial.measure("V6 sag over twice the static one", (0.01 - run.place(0).x[1]) / (2 * sag), 1.05);
  });
}

}  // namespace

std::vector<HardCase> particle_cases() {
  const std::vector<Treatment> dem{{"particles", "", ""}};
  std::vector<HardCase> cases{
      {"D1", "start with overlaps of half a diameter", {"fixed_dt"}, dem, overlapping_start},
      {"D2", "time steps around the limit of stability", {}, dem, at_the_limit},
      {"D3", "Young's modulus 1e7 to 2e11 Pa", {"fixed_dt"}, dem, any_stiffness},
      {"D4", "a small sphere on a large one", {}, dem, small_on_large},
      {"D5", "grazing elastic impacts", {}, dem, grazing_impacts},
      {"D6", "a corner of three walls", {"one_wall"}, dem, corner_of_three},
      {"D7", "dense shear flow of particles", {}, dem, dense_shear},
      {"D8", "a particle held between walls by friction", {"lost_history"}, dem, hangs_by_friction}};
  for (HardCase& one : box_cases()) cases.push_back(std::move(one));
  return cases;
}

}  // namespace polybed::hard
