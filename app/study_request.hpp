// The request to a study of the Python package: the options of its command as a JSON object.
#pragma once

#include <string>

#include "app/options.hpp"
#include "app/studies.hpp"
#include "core/output/json.hpp"

namespace polybed::app {

/// The options of the runs that the study makes.
/// \param kind  of the study's folder: runs/<case name>-<kind> unless -o names another
[[nodiscard]] core::Json common_request(const RunOptions& options, const std::string& kind);

}  // namespace polybed::app
