// What every file of type "polybed solids table" must be: of its kind, undamaged, with numbers that can be meant.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/output/file.hpp"
#include "tfm/solids_table.hpp"

namespace polybed::tfm {

/// Opens a table. Throws core::FileError for another kind of file, and for one whose checksum does not hold.
[[nodiscard]] core::OutputFile open_table(const std::filesystem::path& path);

/// Whether a table carries a checksum; files of earlier versions do not.
[[nodiscard]] bool is_sealed(const core::OutputFile& table);

/// Writes a table with its checksum: CRC-32 over the numbers of all datasets, as doubles of 8 bytes with the low byte
/// first, in the order of the datasets' names.
void save_table(core::OutputFile& table, const std::filesystem::path& path);

/// A new, empty table.
[[nodiscard]] core::OutputFile new_table();

/// Throws core::FileError unless all values lie in a range, ends included; no range holds a NaN.
void require_range(const std::filesystem::path& path, const std::string& name, std::span<const double> values,
                   double least, double most);

/// Throws core::FileError unless there are values, they lie in a range and rise.
void require_axis(const std::filesystem::path& path, const std::string& name, std::span<const double> values,
                  double least, double most);

/// Throws core::FileError for values that no table of sheared particles can have, and for arrays of another size than
/// the axes say.
void require_values(const std::filesystem::path& path, const SolidsTable& table);

/// Throws core::FileError for values that no p_bed can have; whether it rises is the law's to check.
void require_values(const std::filesystem::path& path, const BedPressure& bed);

}  // namespace polybed::tfm
