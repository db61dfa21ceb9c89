#include "multiscale/stability/program.hpp"

#include <limits>

#include "core/files.hpp"
#include "multiscale/stability/scratch.hpp"

namespace polybed::stability {

namespace {

std::string text_of_file(const std::filesystem::path& path) {
  const core::Bytes bytes = core::read_whole_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

ProgramEnd run_program(int ranks, const std::vector<std::string>& words,
                       const std::function<void(const multiscale::ChildProgram&)>& look) {
  const Scratch folder;
  const std::filesystem::path printed = folder.path() / "printed", said = folder.path() / "said";
  const multiscale::ChildExit end =
      multiscale::run_child({words, ranks, printed, said}, std::numeric_limits<double>::infinity(), look);
  return {end.code, text_of_file(printed), text_of_file(said)};
}

}  // namespace polybed::stability
