// One sphere that meets a rigid plane, or the relative motion of two that meet head on: the scalar reference of the
// contact laws, with the scheme of the thesis, T(2.11)-(2.13): U' = U + F dt/(2m), x += U' dt, F = F(x, U'),
// U = U' + F dt/(2m), rotation alike. n points from the plane to the sphere, x along the plane; the spin w is about the
// axis for which the velocity of the contact is v_t + l w.
#pragma once

#include <algorithm>
#include <cmath>

#include "closures/contact_hertz.hpp"
#include "closures/contact_tangential.hpp"
#include "closures/mindlin_deresiewicz.hpp"

namespace polybed::closures::impact {

/// hdd_full: without the factor 2/3; hdd_common: the history that is often used while it slides, xi = -(F_t + c_t
/// v_t)/k_t.
enum class Law { none, hdd, hdd_full, hdd_common, mindlin, mindlin_deresiewicz };

struct Sphere {
  double mass, radius, youngs_modulus, shear_modulus;  ///< m* or m, R* or R, E*, G*
  double beta = 0, friction = 0;
  bool clipped = true;
  Law law = Law::none;
  bool shortened_arm = true;      ///< l = R - delta; false: l = R
  bool whole_first_step = false;  ///< a contact's first step counts as if it had touched all the time
};

struct Motion {
  double overlap, v_n, v_t = 0, spin = 0;  ///< v_n < 0 on approach
};

struct Rebound {
  Motion motion;
  double overlap = 0, force = 0, time = 0;  ///< greatest of both, duration of contact
};

struct Force {
  double normal, tangential;
};

/// What a contact remembers: xi, or for Law::mindlin the force of the spring; the state of law 3 and its normal force.
struct History {
  double spring = 0;
  MindlinDeresiewicz slip = {};
  double normal = 0;
};

/// Force on i, and the history after it: the displacement xi, or for the law "mindlin" the force of the spring.
struct TangentialForce {
  Vec3 force, history;
};

/// Coulomb's cap with history rescale: while it slides the spring holds the whole force, xi = -F_t/k_t; without sliding
/// the history stays. (xi = -(F_t + c_t v_t)/k_t, often used, leaves too little on the spring: in an oblique impact
/// with damping the sphere leaves with 15 to 25 % less tangential impulse at e 0.5.)
/// \param force -k_t xi - c_t v_t  \param stiffness k_t, the secant one, > 0  \param limit mu F_n
inline TangentialForce coulomb_cap(const Vec3& force, const Vec3& displacement, double stiffness, double limit) {
  const double share = coulomb_share(dot(force, force), limit);
  const Vec3 capped = share * force;
  return {capped, select(share < 1, (-1 / stiffness) * capped, displacement)};
}

/// The same for the law "mindlin", whose history is the force of the spring. \param force spring - c_t v_t
inline TangentialForce coulomb_cap_of_force(const Vec3& force, const Vec3& spring, double limit) {
  const double share = coulomb_share(dot(force, force), limit);
  const Vec3 capped = share * force;
  return {capped, select(share < 1, capped, spring)};
}

inline double arm_of(const Sphere& s, const Motion& m) { return s.shortened_arm ? s.radius - m.overlap : s.radius; }

/// Law 3: force of the spring, and its state.
inline double partial_slip(const Sphere& s, double full, double moved, double normal, History& history) {
  const double change = normal - history.normal;
  history.slip = mindlin_deresiewicz(history.slip, {full, moved, s.friction, normal, change});
  history.normal = normal;
  return -history.slip.force;
}

/// Force at the velocities of the half step, and the history after it.
inline Force contact_force(const Sphere& s, const Motion& m, double dt, double overlap_old, History& history) {
  if (!(m.overlap > 0)) {
    history = {};
    return {0, 0};
  }
  const double a = contact_radius(s.radius, m.overlap);
  const double damping = hertz_damping(s.beta, hertz_stiffness(s.youngs_modulus, a), s.mass);
  const NormalForce parts = hertz_force(s.youngs_modulus, a, m.overlap, damping, m.v_n);
  const double normal = s.clipped ? std::max(normal_kept(parts), 0.0) : normal_kept(parts);
  if (s.law == Law::none) return {normal, 0};
  const double full = tangential_stiffness(s.shear_modulus, a), v_t = m.v_t + arm_of(s, m) * m.spin;
  const double c_t = damping * tangential_damping_ratio(s.shear_modulus, s.youngs_modulus);
  const bool touches = !(overlap_old > 0);
  const double moved = v_t * (s.whole_first_step ? dt : time_since_touch(m.overlap, m.v_n, dt));
  if (s.law == Law::mindlin_deresiewicz)
    return {normal, partial_slip(s, touches ? 2.0 / 3 * full : full, moved, normal, history)};
  TangentialForce force;
  if (s.law == Law::mindlin) {
    const Vec3 spring = touches ? Vec3{-2.0 / 3 * full * moved, 0, 0}
                                : mindlin_force({history.spring, 0, 0}, contact_radius(s.radius, overlap_old), a, full,
                                                {v_t, 0, 0}, dt);
    force = coulomb_cap_of_force({spring.x - c_t * v_t, 0, 0}, spring, s.friction * normal);
  } else {
    const double k = s.law == Law::hdd_full ? full : secant_stiffness_hdd(s.shear_modulus, a);
    const Vec3 xi{history.spring + moved, 0, 0};
    force = coulomb_cap(spring_force(k, xi, c_t, {v_t, 0, 0}), xi, k, s.friction * normal);
    if (s.law == Law::hdd_common && force.history.x != xi.x) force.history.x -= c_t * v_t / k;
  }
  history.spring = force.history.x;
  return {normal, force.force.x};
}

/// Height of the parabola through three samples at equal distances around the middle one, the largest.
inline double peak(double before, double middle, double after) {
  const double bend = before - 2 * middle + after, slope = 0.5 * (after - before);
  return bend < 0 ? middle - 0.5 * slope * slope / bend : middle;
}

/// From first touch, or from a gap (negative overlap), until the contact ends.
inline Rebound collide(const Sphere& s, Motion m, double dt) {
  const double inertia = moment_of_inertia(s.mass, s.radius), push = 0.5 * dt / s.mass;
  Rebound out;
  Force force{0, 0};
  History history;
  double time = 0, begin = m.overlap < 0 ? m.overlap / m.v_n : 0;
  double overlap[3] = {0, 0, 0}, forces[3] = {0, 0, 0};
  const auto kick = [&] {
    m.v_n += push * force.normal;
    m.v_t += push * force.tangential;
    m.spin += 0.5 * dt / inertia * arm_of(s, m) * force.tangential;
  };
  while (true) {
    kick();
    const double old = m.overlap;
    m.overlap -= m.v_n * dt;
    time += dt;
    force = contact_force(s, m, dt, old, history);
    kick();
    for (int n = 0; n < 2; ++n) overlap[n] = overlap[n + 1], forces[n] = forces[n + 1];
    overlap[2] = m.overlap;
    forces[2] = force.normal;
    if (overlap[1] >= overlap[0] && overlap[1] > overlap[2]) out.overlap = peak(overlap[0], overlap[1], overlap[2]);
    if (forces[1] >= forces[0] && forces[1] > forces[2]) out.force = peak(forces[0], forces[1], forces[2]);
    if (m.v_n > 0 && m.overlap <= 0) {
      out.motion = m;
      out.time = time - dt + dt * old / (old - m.overlap) - begin;
      return out;
    }
  }
}

/// Duration of the elastic impact at this speed.
inline double elastic_time(const Sphere& s, double speed) {
  const double k = hertz_coefficient(s.youngs_modulus, s.radius);
  return hertz_contact_time(hertz_greatest_overlap(k, s.mass, speed), speed);
}

}  // namespace polybed::closures::impact
