// Studies of both models, which the program calls by their plain names.
#pragma once

namespace polybed::multiscale {}

namespace polybed::app {
using namespace multiscale;
}
