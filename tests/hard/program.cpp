#include "hard/program.hpp"

#include "core/output/files.hpp"
#include "multiscale/program.hpp"
#include "scenes/scratch.hpp"

namespace polybed::hard {

namespace {

std::string text_of_file(const std::filesystem::path& path) {
  const core::Bytes bytes = core::read_whole_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

ProgramEnd run_program(int ranks, const std::vector<std::string>& words,
                       const std::function<void(const ChildProgram&)>& look) {
  const scenes::Scratch folder;
  const std::filesystem::path printed = folder.path() / "printed", said = folder.path() / "said";
  const int code = run_child({words, ranks, printed, said, multiscale::this_program().parent_path() / "polybed"}, look);
  return {code, text_of_file(printed), text_of_file(said)};
}

}  // namespace polybed::hard
