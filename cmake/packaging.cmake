# What `cmake --install` puts beside the program, and the Debian package that `cpack` makes of it (in the build folder).
include(GNUInstallDirs)
find_program(PYTHON_OF_SYSTEM python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)

install(CODE "execute_process(COMMAND ${PYTHON_OF_SYSTEM} ${CMAKE_SOURCE_DIR}/cmake/from_help.py $<TARGET_FILE:polybed>
                                      \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\" COMMAND_ERROR_IS_FATAL ANY)")
install(FILES LICENSE CITATION.cff CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/polybed)

# The documentation as HTML: made by Sphinx, which cmake/packages-tests.txt lists; without it
# the program is built and installed all the same.
add_custom_target(docs COMMAND ${PYTHON_OF_SYSTEM} -m sphinx -q -W --keep-going -c ${CMAKE_SOURCE_DIR}/docs/site
                                -d ${CMAKE_BINARY_DIR}/doctrees ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/html
                  USES_TERMINAL)
install(DIRECTORY ${CMAKE_BINARY_DIR}/html DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/polybed OPTIONAL
        PATTERN ".buildinfo" EXCLUDE PATTERN "_sources" EXCLUDE PATTERN "objects.inv" EXCLUDE)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the polybed authors <noreply@polybed.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "beds of particles of several sizes and densities in a liquid or a gas")
set(CPACK_PACKAGE_DESCRIPTION "polybed simulates fluidised, settled and flowing beds of spheres of several sizes and densities,
as a continuum (two-fluid model) or particle by particle (discrete element method), and reads, draws and compares its runs.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# Libraries are found in the program by dpkg-shlibdeps; its Python package and the start of ranks need the rest.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, python3-numpy, python3-h5py, python3-matplotlib, python3-scipy, python3-pandas, \
python3-xarray, openmpi-bin, libjs-mathjax")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/cmake/debian/postinst ${CMAKE_SOURCE_DIR}/cmake/debian/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
configure_file(${CMAKE_SOURCE_DIR}/cmake/package_contents.cmake.in ${CMAKE_BINARY_DIR}/package_contents.cmake @ONLY)
set(CPACK_INSTALL_SCRIPTS ${CMAKE_BINARY_DIR}/package_contents.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/package_links.cmake)
include(CPack)
