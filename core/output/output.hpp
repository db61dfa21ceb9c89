// Output of a run while it runs: fields, particles, profiles and the history.
#pragma once

#include "core/output/fields.hpp"
#include "core/output/history.hpp"
#include "core/output/particles.hpp"
#include "core/output/profiles.hpp"
