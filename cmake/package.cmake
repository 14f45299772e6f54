# `cmake --install` copies and `cpack` packs the programs, their manual pages, completion for bash, licence and documents.
include(GNUInstallDirs)
set(programs swath-client swath-display swath-server swath-sim)
install(TARGETS ${programs} RUNTIME)
foreach(program IN LISTS programs)
  install(FILES cmake/package/completion.bash RENAME ${program}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endforeach()
# The image is built without these.
install(FILES LICENSE README.md CHANGELOG.md TYPE DOC OPTIONAL)
install(DIRECTORY docs TYPE DOC OPTIONAL PATTERN images EXCLUDE)

# A manual page is what its program says with --help, so the program has to run.
set(pages "")
if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
  message(STATUS "No manual pages: programs for ${CMAKE_SYSTEM_PROCESSOR} do not run here without CMAKE_CROSSCOMPILING_EMULATOR")
else()
  foreach(program IN LISTS programs)
    set(page ${PROJECT_BINARY_DIR}/man/${program}.1.gz)
    add_custom_command(
      OUTPUT ${page}
      COMMAND ${PROJECT_SOURCE_DIR}/cmake/package/manual ${page} ${program} ${PROJECT_VERSION}
        ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:${program}>
      DEPENDS ${program} cmake/package/manual
      VERBATIM)
    list(APPEND pages ${page})
  endforeach()
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
# This target has all that is installed and no test.
add_custom_target(programs ALL DEPENDS ${programs} ${pages})

# Only the Debian package has these.
set(SWATH_MAINTAINER "Swath maintainers <maintainers@swath.example>" CACHE STRING "Who answers for the Debian package")
string(TIMESTAMP SWATH_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH's if that is set
configure_file(cmake/package/changelog.in debian/changelog @ONLY)
execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/debian/changelog COMMAND_ERROR_IS_FATAL ANY)
install(FILES ${PROJECT_BINARY_DIR}/debian/changelog.gz cmake/package/copyright
  TYPE DOC COMPONENT debian EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_INSTALL_CMAKE_PROJECTS
  ${PROJECT_BINARY_DIR} swath ALL / ${PROJECT_BINARY_DIR} swath debian /)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)  # whatever the umask
set(CPACK_PACKAGE_CONTACT ${SWATH_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "cluster renderer for large polygon models, without a GPU")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "\
Swath renders polygon models on a cluster of ordinary machines, as pictures
along a camera path or live in a browser. A picture is byte for byte the one
that a single process draws.
.
This package has all four programs: swath-client, swath-server, swath-display
and swath-sim, which simulates clusters.")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The OpenGL renderers load their drivers at run time; the simulator's plots need gnuplot.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libosmesa6, libegl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS gnuplot-nox)
include(CPack)
