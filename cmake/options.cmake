# Compiler settings shared by every folder.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3")
# One search path of libraries for building and installing: to one that it replaces when it installs, CMake appends an empty entry,
# for which the loader takes libraries from the working directory.
set(CMAKE_BUILD_WITH_INSTALL_RPATH ON)
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)

option(POLYBED_NATIVE "Compile for this machine's processor; off makes programs that run anywhere" OFF)
option(POLYBED_WARNINGS_AS_ERRORS "Stop at a warning" OFF)
option(POLYBED_TESTS "Build the tests" ON)
option(POLYBED_SANITIZE "Address and undefined-behaviour sanitizers" OFF)

add_library(polybed_options INTERFACE)
# g++ 12 sees overlaps and overflows in std::string and fmt that are not there (its bug 105651).
# -Wpsabi: a function that returns a vector register is called otherwise with AVX than without; all of ours are inlined.
target_compile_options(polybed_options INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-psabi)
target_compile_options(polybed_options INTERFACE -Wall -Wextra -Wconversion -ffp-contract=off -fno-math-errno
                                                 $<$<BOOL:${POLYBED_WARNINGS_AS_ERRORS}>:-Werror>
                                                 $<$<BOOL:${POLYBED_NATIVE}>:-march=native>)
if(POLYBED_SANITIZE)
  target_compile_options(polybed_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(polybed_options INTERFACE -fsanitize=address,undefined)
endif()
