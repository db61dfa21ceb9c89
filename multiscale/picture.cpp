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

bool draw_picture(const std::filesystem::path& run_directory, std::string& message) {
  const PythonEnd end = run_python("polybed.plot", {"--picture", "--", run_directory.string()}, PythonOutput::keep);
  message = end.not_started.empty() ? last_line(end.output) : end.not_started;
  return end.not_started.empty() && end.code == 0;
}

}  // namespace polybed::multiscale
