# polybed_joined(target...): sources are compiled eight at a time. Half of the time to compile one is its headers.
function(polybed_joined)
  set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# polybed_folder(name libraries...): one library per folder, made of the sources that lie in it. The list of
# libraries is the list of what the folder may use.
function(polybed_folder name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  if(sources)
    add_library(polybed_${name} STATIC ${sources})
    target_include_directories(polybed_${name} PUBLIC ${CMAKE_SOURCE_DIR})
    target_link_libraries(polybed_${name} PUBLIC polybed_options ${ARGN})
    polybed_joined(polybed_${name})
  else()
    add_library(polybed_${name} INTERFACE)
    target_include_directories(polybed_${name} INTERFACE ${CMAKE_SOURCE_DIR})
    target_link_libraries(polybed_${name} INTERFACE polybed_options ${ARGN})
  endif()
endfunction()
