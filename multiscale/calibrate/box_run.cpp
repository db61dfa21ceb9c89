// Runs a sheared box and measures its stress.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "closures/kinetic_theory.hpp"
#include "closures/species_exchange_kinetic.hpp"
#include "closures/sphere.hpp"
#include "closures/stress_reference.hpp"
#include "core/timers.hpp"
#include "dem/measures.hpp"
#include "dem/stress.hpp"
#include "multiscale/calibrate/box_result.hpp"
#include "multiscale/calibrate/reference.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

/// Four or five samples of the stress per contact: the sum over half a sine wave is then exact to 1e-3.
constexpr std::int64_t steps_per_look = 4;
constexpr int blocks_of_a_run = 20;

/// Target of a push for the difference of the mean velocities over sqrt(theta): slow, as in the reference, and well
/// above noise.
constexpr double slip_aimed_at = 0.25;

/// Averages over a block, SI; followed by theta_j.
enum Column : std::size_t {
  theta,
  pressure,
  shear,
  first_normal,
  second_normal,
  contact,
  contacts,
  dissipation,
  first
};

class BoxRun {
 public:
  BoxRun(const core::Scene& scene, const BoxPoint& point)
      : plan_(scene.calibrate), box_(scene_of_box(scene, point)), model_(box_, timers_) {
    result_.point = point;
    result_.hash = box_hash(scene, point);
    volume_ = box_.column.size[0] * box_.column.size[1] * box_.column.size[2];
    for (std::size_t j = 0; j < box_.species.size(); ++j) {
      const dem::Species& s = model_.materials().species()[j];
      number_.push_back(double(box_.bed.particles[j]));
      mass_ += number_.back() * s.mass;
      phi_.push_back(number_.back() * closures::sphere_volume(s.radius) / volume_);
    }
    rows_.resize(first + box_.species.size());
    if (point.pushed) choose_push();
  }

  BoxResult run() {
    const double begin = core::cpu_seconds();
    run_for(plan_.discard_strain);
    begin_energy_ = stored_energy();
    begin_ = dem::totals_of(model_);
    double strain = plan_.strain;
    for (int n = 0; n < blocks_of_a_run; ++n) add_block(strain / blocks_of_a_run);
    const double block = strain / blocks_of_a_run;
    for (int n = 0; n < plan_.doublings && (error_grows(rows_[pressure]) || error_grows(rows_[shear])); ++n) {
      const auto more = std::llround(strain / block);
      for (std::int64_t k = 0; k < more; ++k) add_block(block);
      strain *= 2;
    }
    finish(strain);
    result_.cpu_seconds = core::cpu_seconds() - begin;
    result_.particle_steps = double(model_.work().particle_steps);
    return result_;
  }

 private:
  void run_for(double strain) {
    for (std::int64_t n = std::llround(strain / box_.column.shear_rate / model_.limits().dt); n > 0; --n) {
      if (n % steps_per_look == 0) push();
      model_.step(1e300);
    }
  }

  void add_block(double strain) {
    std::vector<double> sum(rows_.size(), 0.0);
    double slip = 0;
    const dem::Totals before = dem::totals_of(model_);
    const double duration = strain / box_.column.shear_rate;
    const auto looks =
        std::max<std::int64_t>(std::llround(duration / (double(steps_per_look) * model_.limits().dt)), 1);
    for (std::int64_t n = 0; n < looks; ++n) {
      push();
      for (std::int64_t k = 0; k < steps_per_look; ++k) model_.step(1e300);
      add_look(sum);
      if (!push_.empty()) slip += drift_apart() / double(looks);
    }
    slips_.push_back(slip);
    const dem::Totals after = dem::totals_of(model_);
    const double time = double(looks * steps_per_look) * model_.limits().dt;
    sum[dissipation] = double(looks) * (after.dissipated - before.dissipated) / (time * volume_);
    for (std::size_t q = 0; q < sum.size(); ++q) rows_[q].push_back(sum[q] / double(looks));
    result_.max_overlap = std::max(result_.max_overlap, after.max_overlap / model_.materials().least_diameter());
    time_ += time;
  }

  /// Chooses opposite forces along z, in which shear has no effect, for the target slip by the reference at the initial
  /// temperature of the box.
  void choose_push() {
    const double theta = box_.dem.start_speed * box_.dem.start_speed;
    force_ = exchange_reference(theta, theta, 0) * slip_aimed_at * std::sqrt(theta);
    const double time = double(steps_per_look) * model_.limits().dt;
    for (std::size_t j = 0; j < 2; ++j)
      push_.push_back({0, 0, (j == 0 ? 1 : -1) * force_ * time / (phi_[j] * box_.species[j].density)});
  }
  void push() {
    if (!push_.empty()) model_.push(push_);
  }
  /// <U_z> of the first species minus the second's, m/s.
  [[nodiscard]] double drift_apart() const {
    std::array<double, 2> sum{};
    const dem::Particles& p = model_.particles();
    for (std::size_t i = 0; i < p.owned; ++i) sum[std::size_t(p.species[i])] += p.motion[i].v[2];
    return sum[0] / number_[0] - sum[1] / number_[1];
  }
  [[nodiscard]] double exchange_reference(double theta_1, double theta_2, double drift) const {
    const auto at = [&](std::size_t j, double value) {
      return closures::DriftingSpecies{box_.species[j].diameter, box_.species[j].density, phi_[j], value};
    };
    const closures::DriftingSpecies one = at(0, theta_1), two = at(1, theta_2);
    const double g = closures::radial_of_pair(1 - one.phi - two.phi, one.phi / one.diameter + two.phi / two.diameter,
                                              one.diameter, two.diameter);
    const BoxPoint& p = result_.point;
    return closures::species_exchange_kinetic(one, two, g, closures::effective_restitution(p.restitution, p.friction),
                                              drift);
  }
  void find_exchange() {
    const Estimate slip = estimate_of(slips_);
    const double beta = force_ / slip.mean, relative = slip.error / std::abs(slip.mean);
    const double form =
        exchange_reference(estimate_of(rows_[first]).mean, estimate_of(rows_[first + 1]).mean, std::abs(slip.mean));
    result_.exchange = {beta, std::abs(beta) * relative};
    result_.exchange_ratio = {beta / form, std::abs(beta / form) * relative};
    result_.slip = slip.mean / std::sqrt(result_.theta.mean);
  }

  void add_look(std::vector<double>& sum) {
    const dem::Stress s = dem::stress_of(model_);
    sum[pressure] += s.pressure();
    sum[shear] += s.shear();
    sum[first_normal] += s.component(0, 0) - s.component(1, 1);
    sum[second_normal] += s.component(1, 1) - s.component(2, 2);
    sum[contact] += (s.contact[0][0] + s.contact[1][1] + s.contact[2][2]) / 3;
    sum[contacts] += double(s.contacts) / double(model_.particle_count());
    for (std::size_t j = 0; j < phi_.size(); ++j) {
      sum[first + j] += s.temperature[j];
      sum[theta] += s.temperature[j] * number_[j] * model_.materials().species()[j].mass / mass_;
    }
  }

  /// Energy of the fluctuations and in the springs, J.
  [[nodiscard]] double stored_energy() {
    const dem::Stress s = dem::stress_of(model_);
    return 0.5 * volume_ * (s.kinetic[0][0] + s.kinetic[1][1] + s.kinetic[2][2]) + dem::totals_of(model_).elastic +
           dem::totals_of(model_).rotational;
  }

  void finish(double strain) {
    BoxResult& r = result_;
    const double rate = box_.column.shear_rate;
    std::vector<double> share;
    double solids = 0;
    for (const double phi : phi_) solids += phi;
    for (const double phi : phi_) share.push_back(phi / solids);
    const MeanSphere mean = mean_sphere(box_.species, share);
    r.shear_rate = rate;
    r.diameter = mean.diameter;
    r.density = mean.density;
    r.strain = strain;
    r.theta = estimate_of(rows_[theta]);
    r.pressure = estimate_of(rows_[pressure]);
    const Estimate stress = estimate_of(rows_[shear]);
    r.viscosity = {stress.mean / rate, stress.error / rate};
    r.dissipation = estimate_of(rows_[dissipation]);
    r.first_normal = estimate_of(rows_[first_normal]).mean / r.pressure.mean;
    r.second_normal = estimate_of(rows_[second_normal]).mean / r.pressure.mean;
    r.contact_share = estimate_of(rows_[contact]).mean / r.pressure.mean;
    r.contacts = estimate_of(rows_[contacts]).mean;
    r.temperature_ratio = {1, 0};
    if (phi_.size() == 2) r.temperature_ratio = ratio_of_temperatures();
    find_sink(rate);
    const dem::Totals after = dem::totals_of(model_);
    const double stored = (stored_energy() - begin_energy_) / (volume_ * time_);
    const double lost = (after.dissipated - begin_.dissipated) / (volume_ * time_);
    const double pushed = push_.empty() ? 0 : force_ * estimate_of(slips_).mean;
    r.balance = (stress.mean * rate + pushed) / (lost + r.sink + stored);
    r.drift = drift();
    find_ratios();
    if (!push_.empty()) find_exchange();
    r.softness = softness();
  }

  [[nodiscard]] Estimate ratio_of_temperatures() const {
    std::vector<double> ratio = rows_[first + 1];
    const double m = model_.materials().species()[1].mass / model_.materials().species()[0].mass;
    for (std::size_t n = 0; n < ratio.size(); ++n) ratio[n] *= m / rows_[first][n];
    return estimate_of(ratio);
  }

  /// 3 n_j k_j theta_j: loss of the fluctuations to drag.
  void find_sink(double rate) {
    if (model_.affine_drag() == nullptr) return;
    double drag = 0;
    for (std::size_t j = 0; j < phi_.size(); ++j) {
      const double k = model_.affine_drag()->coefficient(j);
      result_.sink += 3 * number_[j] / volume_ * k * estimate_of(rows_[first + j]).mean;
      drag += number_[j] * k;
    }
    result_.drag_rate = drag / (mass_ * rate);
  }

  void find_ratios() {
    BoxResult& r = result_;
    ReferenceStress form{};
    if (r.point.regime == core::BoxRegime::dry) {
      std::vector<BoxSpecies> species;
      for (std::size_t j = 0; j < phi_.size(); ++j)
        species.push_back(
            {box_.species[j].diameter, box_.species[j].density, phi_[j], estimate_of(rows_[first + j]).mean});
      form = kinetic_reference(species, closures::effective_restitution(r.point.restitution, r.point.friction));
    } else {
      form = viscous_reference(r.point.phi, r.point.friction, relevance::fluid_constants(box_.fluid).viscosity,
                               box_.column.shear_rate);
    }
    const auto over = [](const Estimate& e, double unit) { return Estimate{e.mean / unit, e.error / unit}; };
    r.pressure_ratio = over(r.pressure, form.pressure);
    r.viscosity_ratio = over(r.viscosity, form.viscosity);
    r.dissipation_ratio = over(r.dissipation, form.dissipation);
  }

  [[nodiscard]] double drift() const {
    dem::Vector sum{};
    double all = 0;
    for (std::size_t i = 0; i < model_.particles().owned; ++i) {
      const dem::Motion& m = model_.particles().motion[i];
      dem::Vector v = m.v;
      v[0] -= box_.column.shear_rate * model_.particles().place[i].x[1];
      for (std::size_t k = 0; k < 3; ++k) sum[k] += v[k] / m.inverse_mass;
      all += std::hypot(v[0], v[1], v[2]) / m.inverse_mass;
    }
    return std::hypot(sum[0], sum[1], sum[2]) / all;
  }

  /// t_c/tau at the measured temperature.
  [[nodiscard]] double softness() const {
    const double g0 = closures::radial_distribution_dense(result_.point.phi).value;
    const double tau =
        std::sqrt(std::numbers::pi) * result_.diameter / (24 * result_.point.phi * g0 * std::sqrt(result_.theta.mean));
    return model_.laws().normal->contact_time(0, 1) / tau;
  }

  core::Calibrate plan_;
  core::Scene box_;
  core::Timers timers_;
  dem::Model model_;
  BoxResult result_;
  double volume_ = 0, mass_ = 0, begin_energy_ = 0, time_ = 0;
  dem::Totals begin_;
  std::vector<double> number_, phi_;
  std::vector<dem::Vector> push_;          ///< change of velocity at each sample; empty: no push
  std::vector<double> slips_;              ///< of each block, m/s
  double force_ = 0;                       ///< on each species, N/m3
  std::vector<std::vector<double>> rows_;  ///< [Column][block]
};

}  // namespace

BoxResult run_box(const core::Scene& scene, const BoxPoint& point, std::shared_ptr<const core::Ranks> ranks) {
  if (point.regime == core::BoxRegime::bed) return run_bed_box(scene, point, std::move(ranks));
  return BoxRun(scene, point).run();
}

}  // namespace polybed::multiscale
