// Files of drag laws, written by `polybed fit` and by studies of a law's uncertainty.
//
//   {"filetype": "polybed drag law", "version": 1,
//    "form": "cello", "constants": {"k1_linear": 128, ...},     or "law": "wen_yu", one of the menu
//    "common": 1.04, "tilt": 0.01,                              left out: 1 and 0; see closures::DragLaw
//    "range": {"voidage": [0.4, 0.9], "reynolds": [0, 100]},    of the rows of the fit; left out: unknown
//    "band": {...}, "fit": {...}}                               for people and studies, not read here
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "closures/drag_form.hpp"

namespace polybed::relevance {

struct DragFile {
  std::string form;                         ///< empty: `law`
  std::map<std::string, double> constants;  ///< of the form
  std::string law;
  double common = 1, tilt = 0;
  std::optional<closures::FittedRange> range;
  std::string hash;  ///< of the file's text
};

/// Throws core::CaseError with file, line and column of every problem; core::FileError if the file cannot be read.
[[nodiscard]] DragFile read_drag_file(const std::filesystem::path& path);

/// Record of a law file, which can change later, for a run: path, hash, form, constants and range, as JSON.
[[nodiscard]] std::string record_of(const std::filesystem::path& path, const DragFile& file);

/// The law of a file, without a partition.
[[nodiscard]] closures::DragLaw law_of_file(const DragFile& file, closures::Guard guard);

/// What is known about the range of a fitted law: "voidage 0.4 to 0.9, Re 0 to 100" or "unknown"; empty for the menu's.
[[nodiscard]] std::string fitted_range(const closures::DragLaw& law);

}  // namespace polybed::relevance
