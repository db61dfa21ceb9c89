# Where Debian's Python and its tools look: the package lies beside the cases, the licence is Debian's copyright file.
set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr)
file(MAKE_DIRECTORY ${usr}/lib/python3/dist-packages)
file(CREATE_LINK ../../../share/polybed/python/polybed ${usr}/lib/python3/dist-packages/polybed SYMBOLIC)
file(RENAME ${usr}/share/doc/polybed/LICENSE ${usr}/share/doc/polybed/copyright)
file(REMOVE_RECURSE ${usr}/share/doc/polybed/html/_static/mathjax)
file(CREATE_LINK ../../../../javascript/mathjax ${usr}/share/doc/polybed/html/_static/mathjax SYMBOLIC)
