// A table of the solids stress moved by its standard errors: what a run with it says of the uncertainty of another.
#pragma once

#include <filesystem>

namespace polybed::multiscale {

/// Writes a table whose pressures and viscosities are those of another plus `sigma` of their standard errors. Throws
/// core::CaseError if it has none, or if its pressure would fall with phi.
void write_moved_table(const std::filesystem::path& table, double sigma, const std::filesystem::path& moved);

}  // namespace polybed::multiscale
