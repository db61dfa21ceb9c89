// What a run leaves on the disk while it runs: fields, particles, profiles and the history.
#pragma once

#include "core/output_fields.hpp"
#include "core/output_history.hpp"
#include "core/output_particles.hpp"
#include "core/output_profiles.hpp"
