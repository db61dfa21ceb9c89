// polybed measure --list: the tables of measures themselves.
#pragma once

#include "app/options.hpp"

namespace polybed::multiscale {

/// Every measure with its unit and definition: a text, JSON, or the page of the documentation.
void print_measures(const MeasureOptions& options);

}  // namespace polybed::multiscale
