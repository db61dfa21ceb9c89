// polybed compare: hands over to the Python package.
#include "app/options.hpp"
#include "multiscale/python_module.hpp"

namespace polybed::app {

void run_compare(const std::vector<std::string>& words) { become_python("polybed.study.compare", words); }

}  // namespace polybed::app
