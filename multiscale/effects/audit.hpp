// The audit of a finished run: what it left out, evaluated on all that it stored.
#pragma once

#include <filesystem>

#include "multiscale/effects/neglected.hpp"

namespace polybed::multiscale {

/// Every stored step of a run but that of the start: of the two-fluid model every species in every cell where it is a
/// thousandth of the volume, of particles every one of them. Throws FileError for a run without stored fields of its
/// fluid.
[[nodiscard]] Neglected audit_run(const std::filesystem::path& directory);

}  // namespace polybed::multiscale
