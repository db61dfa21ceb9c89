// --closure-uncertainty of polybed inversion and polybed tfm: what the uncertainty of the drag law means for the
// answer.
#pragma once

#include "app/options.hpp"

namespace polybed::app {

/// Becomes the study that finds the answer with the case's drag law and with the law moved within its band. Throws
/// core::CaseError if the case has no drag law.
/// \param kind  "inversion" or "tfm"  \param method  of the inversion
[[noreturn]] void run_closure_uncertainty(const RunOptions& options, const std::string& kind,
                                          const std::string& method = "");

}  // namespace polybed::app
