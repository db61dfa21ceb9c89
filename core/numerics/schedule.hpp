// When something happens in a run, and which times mean the same event.
#pragma once

namespace polybed::core {

struct Scene;

/// Whether two times are one event: they differ by less than 1e-12 of the larger. Rounding leaves less between 3 * 0.1
/// and 0.3, and no step is meant to be so short: IDA refuses to start one of 1e-15 of the time and skips one of 2e-14.
[[nodiscard]] bool same_time(double a, double b);

/// Whether time a comes after b and is not the same event.
[[nodiscard]] bool is_later(double a, double b);

/// The first multiple of a period that is later than a time, s; infinity if the period is 0. Multiples are counted, so
/// that they do not drift.
[[nodiscard]] double next_multiple(double every, double time);

/// Gives all tables of what flows in (inlet, jets, feeds) one time for each event: a jump that is written with two
/// times of one event becomes one, and jumps of several tables meet.
void join_times(Scene& scene);

}  // namespace polybed::core
