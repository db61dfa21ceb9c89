// The times of events in a run, and which times are the same event.
#pragma once

namespace polybed::core {

struct Scene;

/// Whether two times are one event: they differ by less than 1e-12 of the larger. Rounding leaves less between 3 * 0.1
/// and 0.3, and no real step is so short: IDA refuses to start one of 1e-15 of the time and skips one of 2e-14.
[[nodiscard]] bool same_time(double a, double b);

/// Whether time a comes after b and is not the same event.
[[nodiscard]] bool is_later(double a, double b);

/// The first multiple of a period after a time, s; infinity if the period is 0. Multiples are counted, so they do not
/// drift.
[[nodiscard]] double next_multiple(double every, double time);

/// Makes the times of one event equal in all inflow tables (inlet, jets, feeds): a jump written with two times of one
/// event becomes one, and jumps in several tables coincide.
void join_times(Scene& scene);

}  // namespace polybed::core
