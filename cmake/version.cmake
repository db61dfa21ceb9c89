# Writes the source file that holds the version and the commit, at every build, but touches it only if they have
# changed: a commit costs one small file and the link. Run as cmake -DSOURCE=... -DOUTPUT=... -DVERSION=... -P.
set(COMMIT "unknown")
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --dirty --abbrev=40 --exclude=*
                  OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed AND NOT described STREQUAL "")
    set(COMMIT ${described})
  endif()
endif()
configure_file(${SOURCE}/core/version.cpp.in ${OUTPUT} @ONLY)
