#include "core/print.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string_view>

namespace polybed::core {

namespace {

int first_refusal = 0;  // the reason behind the error flag of standard output, which the system keeps for none

}  // namespace

void put(std::FILE* stream, const std::string& text) {
  const bool taken = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  if (!taken && stream == stdout && first_refusal == 0) first_refusal = errno;
}

bool is_terminal(std::FILE* stream) { return isatty(fileno(stream)) == 1; }

std::string painted(std::FILE* stream, Colour colour, const std::string& text) {
  const char *refused = std::getenv("NO_COLOR"), *terminal = std::getenv("TERM");
  constexpr std::string_view without_colours = "dumb";
  const bool plain = (refused != nullptr && *refused != '\0') || terminal == nullptr || terminal == without_colours ||
                     !is_terminal(stream);
  if (plain) return text;
  constexpr int codes[] = {1, 31, 32, 33, 34};  // of ECMA-48, in the order of Colour
  return fmt::format("\033[{}m{}\033[0m", codes[std::size_t(colour)], text);
}

std::string shell_word(const std::string& word) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_@%+=:,./-";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char letter : word) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

int refusal_of_answer() {
  const bool taken = std::fflush(stdout) == 0;
  if (first_refusal != 0) return first_refusal;
  if (!taken) return errno;
  return std::ferror(stdout) != 0 ? EIO : 0;
}

}  // namespace polybed::core
