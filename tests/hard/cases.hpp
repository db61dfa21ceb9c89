// The groups of the catalogue.
#pragma once

#include <vector>

#include "hard/hard_case.hpp"

namespace polybed::hard {

[[nodiscard]] std::vector<HardCase> closure_cases();     // T5 T6 T7 T9
[[nodiscard]] std::vector<HardCase> wave_cases();        // T7 grids, T8
[[nodiscard]] std::vector<HardCase> settling_cases();    // T1 T2 T3 T17
[[nodiscard]] std::vector<HardCase> fluidised_cases();   // T4 T16 T22 T23
[[nodiscard]] std::vector<HardCase> inertia_cases();     // T27 T28
[[nodiscard]] std::vector<HardCase> transport_cases();   // T10 T19 T25
[[nodiscard]] std::vector<HardCase> column_cases();      // T13 T15 T26, on demand
[[nodiscard]] std::vector<HardCase> demanding_cases();   // T11 T12 T18 T20 T21 T24, on demand
[[nodiscard]] std::vector<HardCase> leaning_cases();     // T14, on demand
[[nodiscard]] std::vector<HardCase> round_cases();       // T29 to T33, D16, C13
[[nodiscard]] std::vector<HardCase> unit_cases();        // V12
[[nodiscard]] std::vector<HardCase> particle_cases();    // D1 to D15
[[nodiscard]] std::vector<HardCase> suspension_cases();  // C1, C4 to C10
[[nodiscard]] std::vector<HardCase> one_sphere_cases();  // C2 C3
[[nodiscard]] std::vector<HardCase> sound_cases();       // C11
[[nodiscard]] std::vector<HardCase> level_cases();       // C12
[[nodiscard]] std::vector<HardCase> rank_cases();        // P1 to P10
[[nodiscard]] std::vector<HardCase> input_cases();       // I1 to I10

}  // namespace polybed::hard
