#include "multiscale/become.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace polybed::multiscale {

std::vector<std::string> environment() {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) all.emplace_back(*entry);
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

std::string become(std::vector<std::string> words, std::vector<std::string> variables) {
  ::execve(words.front().c_str(), pointers_to(words).data(), pointers_to(variables).data());
  return std::system_category().message(errno);
}

}  // namespace polybed::multiscale
