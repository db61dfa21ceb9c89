#include "multiscale/picture.hpp"

#include "multiscale/python_module.hpp"

namespace polybed::multiscale {

namespace {

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t begin = text.rfind('\n');
  return begin == std::string::npos ? text : text.substr(begin + 1);
}

}  // namespace

bool draw(const std::string& module, const std::filesystem::path& directory, std::string& message,
          std::vector<std::string> options) {
  options.insert(options.end(), {"--", directory.string()});
  const PythonEnd end = run_python(module, options, PythonOutput::keep);
  message = end.not_started.empty() ? last_line(end.output) : end.not_started;
  return end.not_started.empty() && end.code == 0;
}

bool draw_picture(const std::filesystem::path& run_directory, std::string& message) {
  return draw("polybed.plot", run_directory, message, {"--picture"});
}

}  // namespace polybed::multiscale
