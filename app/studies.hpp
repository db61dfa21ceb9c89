// The program calls the studies of both models by their plain names.
#pragma once

namespace polybed::multiscale {}

namespace polybed::app {
using namespace multiscale;
}
