// polybed measure --list: the tables of measures themselves.
#pragma once

#include "app/options.hpp"
#include "app/studies.hpp"

namespace polybed::app {

/// Every measure with its unit and definition: a text, JSON, or the page of the documentation.
void print_measures(const MeasureOptions& options);

}  // namespace polybed::app
