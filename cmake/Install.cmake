# What `cmake --install` puts in place, wherever the prefix is at that time. The program finds the library, and the
# package its files, by their places relative to each other.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/wheelwright)
file(RELATIVE_PATH library_from_program ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set_target_properties(wheelwright PROPERTIES INSTALL_RPATH "$ORIGIN/${library_from_program}")

install(TARGETS wheelwright RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(TARGETS libwheelwright EXPORT wheelwright
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program NAMELINK_COMPONENT development
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)

install(EXPORT wheelwright NAMESPACE wheelwright:: FILE wheelwrightConfig.cmake DESTINATION ${package_folder}
  COMPONENT development)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/wheelwrightConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/wheelwrightConfigVersion.cmake DESTINATION ${package_folder} COMPONENT development)

file(RELATIVE_PATH prefix_from_pkgconfig
  ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/wheelwright.pc.in ${PROJECT_BINARY_DIR}/wheelwright.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/wheelwright.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs cases examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY python/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/python COMPONENT program
  PATTERN __pycache__ EXCLUDE)
if(WHEELWRIGHT_SITE)
  add_custom_target(site ALL COMMAND ${PROJECT_SOURCE_DIR}/scripts/build-docs ${PROJECT_BINARY_DIR}/docs VERBATIM)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/docs/html DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
endif()
install(FILES packaging/wheelwright.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES packaging/wheelwright.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME wheelwright COMPONENT program)

if(WHEELWRIGHT_NATIVE)
  install(CODE [[message(WARNING
    "This build runs on processors like the one of this machine only. The preset `package` builds for all.")]])
endif()
