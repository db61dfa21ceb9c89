# polybed_joined(target...): sources are compiled eight at a time. Half of the time to compile one is its headers.
function(polybed_joined)
  set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# polybed_not_hot(target...): what reads cases, chooses effects or writes files takes no time that more optimisation would save, and half as
# long to compile with less. Numbers are the same: no option lets a compiler change them.
function(polybed_not_hot)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

# polybed_folder(name libraries...): one library per folder, made of the sources that lie in it. The list of
# libraries is the list of what the folder may use. Subfolders named in not_hot_<name> are compiled as polybed_not_hot, those
# in apart_<name> left to libraries of their own.
function(polybed_folder name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  foreach(part ${apart_${name}})
    list(FILTER sources EXCLUDE REGEX "/${name}/${part}/")
  endforeach()
  foreach(part ${not_hot_${name}})
    set(of_part ${sources})
    list(FILTER of_part INCLUDE REGEX "/${name}/${part}/")
    list(REMOVE_ITEM sources ${of_part})
    add_library(polybed_${name}_${part} OBJECT ${of_part})
    target_include_directories(polybed_${name}_${part} PUBLIC ${CMAKE_SOURCE_DIR})
    target_link_libraries(polybed_${name}_${part} PUBLIC polybed_options ${ARGN})
    polybed_joined(polybed_${name}_${part})
    polybed_not_hot(polybed_${name}_${part})
    list(APPEND objects $<TARGET_OBJECTS:polybed_${name}_${part}>)
  endforeach()
  if(sources)
    add_library(polybed_${name} STATIC ${sources} ${objects})
    target_include_directories(polybed_${name} PUBLIC ${CMAKE_SOURCE_DIR})
    target_link_libraries(polybed_${name} PUBLIC polybed_options ${ARGN})
    polybed_joined(polybed_${name})
  else()
    add_library(polybed_${name} INTERFACE)
    target_include_directories(polybed_${name} INTERFACE ${CMAKE_SOURCE_DIR})
    target_link_libraries(polybed_${name} INTERFACE polybed_options ${ARGN})
  endif()
endfunction()
