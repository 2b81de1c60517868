# Debian packages by `cpack`: penumbra, the program, and libpenumbra-dev, the libraries to build on.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME penumbra)
set(CPACK_PACKAGE_CONTACT "Penumbra maintainers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "radiosity of polygonal scenes with exact shadows")
set(CPACK_PACKAGE_DESCRIPTION "Penumbra computes the light in a scene of diffuse polygons once, with exact form factors\n\
and a mesh that follows the edges of shadows, and shows the scene from any viewpoint.")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_STRIP_FILES ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME penumbra)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)  # reads which libraries the program needs
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libpenumbra-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libglm-dev, libcgal-dev, libgmp-dev, libmpfr-dev, libembree-dev, libtbb-dev, libfmt-dev, libopenexr-dev, libhdf5-dev")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "The program.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Static libraries, headers, and files for CMake and pkg-config.")
include(CPack)
