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
install(TARGETS penumbra RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(TARGETS ${exported} EXPORT penumbra-targets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY solver mesh display DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/penumbra"
        FILES_MATCHING PATTERN "*.h" PATTERN "display/viewer" EXCLUDE)
install(EXPORT penumbra-targets NAMESPACE penumbra:: DESTINATION "${package_folder}")

configure_package_config_file(cmake/penumbra-config.cmake.in "${PROJECT_BINARY_DIR}/package/penumbra-config.cmake"
                              INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/package/penumbra-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/package/penumbra-config.cmake"
              "${PROJECT_BINARY_DIR}/package/penumbra-config-version.cmake"
              cmake/FindHDF5Serial.cmake
        DESTINATION "${package_folder}")
