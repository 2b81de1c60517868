# What other projects link to, and what `cmake --install` puts where: the program, static libraries, their headers by the
# paths by which they are included, and the files that find_package(penumbra) reads.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# All libraries but that of the window.
add_library(penumbra_all INTERFACE)
target_link_libraries(penumbra_all INTERFACE penumbra_display)
set_target_properties(penumbra_all PROPERTIES EXPORT_NAME penumbra)
add_library(penumbra::penumbra ALIAS penumbra_all)

set(exported penumbra_options penumbra_all)
foreach(name base geometry scene visibility transport mesh display)
  set_target_properties(penumbra_${name} PROPERTIES EXPORT_NAME ${name})
  list(APPEND exported penumbra_${name})
endforeach()
set_target_properties(penumbra_options PROPERTIES EXPORT_NAME options)

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/penumbra")
install(TARGETS penumbra RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
install(TARGETS ${exported} EXPORT penumbra-targets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
install(DIRECTORY solver mesh display DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/penumbra" COMPONENT development
        FILES_MATCHING PATTERN "*.h" PATTERN "display/viewer" EXCLUDE)
install(EXPORT penumbra-targets NAMESPACE penumbra:: DESTINATION "${package_folder}" COMPONENT development)

configure_package_config_file(cmake/penumbra-config.cmake.in "${PROJECT_BINARY_DIR}/package/penumbra-config.cmake"
                              INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/package/penumbra-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/package/penumbra-config.cmake"
              "${PROJECT_BINARY_DIR}/package/penumbra-config-version.cmake"
              cmake/FindHDF5Serial.cmake
        DESTINATION "${package_folder}" COMPONENT development)

# For builds without CMake. Variables of installed code have names that no component has.
configure_file(cmake/penumbra.pc.in package/penumbra.pc.in @ONLY)
install(CODE "set(penumbra_libraries \"${CMAKE_INSTALL_LIBDIR}\")
set(penumbra_template \"${PROJECT_BINARY_DIR}/package/penumbra.pc.in\")" COMPONENT development)
install(CODE [[
  file(READ "${penumbra_template}" penumbra_text)
  string(REPLACE "[PREFIX]" "${CMAKE_INSTALL_PREFIX}" penumbra_text "${penumbra_text}")
  file(WRITE "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${penumbra_libraries}/pkgconfig/penumbra.pc" "${penumbra_text}")
]] COMPONENT development)

# Manual pages and completion, which the program makes of its own options.
install(CODE "set(penumbra_program \"$<TARGET_FILE:penumbra>\")
set(penumbra_manual \"${CMAKE_INSTALL_MANDIR}\")
set(penumbra_data \"${CMAKE_INSTALL_DATADIR}\")" COMPONENT program)
install(CODE [[
  set(penumbra_root "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
  file(MAKE_DIRECTORY "${penumbra_root}/${penumbra_manual}/man1" "${penumbra_root}/${penumbra_data}/bash-completion/completions"
       "${penumbra_root}/${penumbra_data}/zsh/vendor-completions")
  execute_process(COMMAND "${penumbra_program}" manual-page --folder "${penumbra_root}/${penumbra_manual}/man1" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${penumbra_program}" completion bash COMMAND_ERROR_IS_FATAL ANY
                  OUTPUT_FILE "${penumbra_root}/${penumbra_data}/bash-completion/completions/penumbra")
  execute_process(COMMAND "${penumbra_program}" completion zsh COMMAND_ERROR_IS_FATAL ANY
                  OUTPUT_FILE "${penumbra_root}/${penumbra_data}/zsh/vendor-completions/_penumbra")
]] COMPONENT program)

# The window in menus of desktops, and what a package says of itself.
install(FILES cmake/package/penumbra.desktop DESTINATION "${CMAKE_INSTALL_DATADIR}/applications" COMPONENT program)
install(FILES cmake/package/penumbra.svg DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps"
        COMPONENT program)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME copyright COMPONENT program)
install(FILES CITATION.cff README.md CHANGELOG.md thesis_notes/report.schema.json
        DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)

include(PenumbraPackage)
