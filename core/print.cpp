#include "core/print.hpp"

#include <cerrno>

namespace polybed::core {

namespace {

int first_refusal = 0;  // the reason behind the error flag of standard output, which the system keeps for none

}  // namespace

void put(std::FILE* stream, const std::string& text) {
  const bool taken = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  if (!taken && stream == stdout && first_refusal == 0) first_refusal = errno;
}

int refusal_of_answer() {
  const bool taken = std::fflush(stdout) == 0;
  if (first_refusal != 0) return first_refusal;
  if (!taken) return errno;
  return std::ferror(stdout) != 0 ? EIO : 0;
}

}  // namespace polybed::core
