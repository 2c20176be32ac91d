# `cpack` makes Debian packages of the components of install.cmake. dpkg-shlibdeps finds the packages that the binaries depend on.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME corotet)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_VENDOR "The corotet authors")
set(CPACK_PACKAGE_CONTACT "The corotet authors <authors@corotet.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "dynamic deformation of elastic solids")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# The package gets control files that tell the system which shared library it has, and that update the system's cache of libraries.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "corotet computes how elastic solids move and deform: tetrahedra of degree 1, 2 and 3,
corotational elasticity for large rotations, implicit and explicit time integration.
This package has the program and ready cases.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME corotet)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The recommended packages are for runs on several ranks, for pictures of convergence studies, and for the pages of runs.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "openmpi-bin, python3, python3-matplotlib, python3-numpy, python3-h5py, python3-vtk9, libjs-three")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, python3-pyvista, xvfb")

set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers and CMake files of corotet's library, for programs that add forces, time integrators
or a loop of their own.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME corotet-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "corotet (= ${PROJECT_VERSION}), libdeal.ii-dev (>= ${DEAL_II_PACKAGE_VERSION})")
if(NOT BUILD_SHARED_LIBS)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libfmt-dev, libsuitesparse-dev, libmuparser-dev, libginac-dev, libcln-dev")
  if(COROTET_WITH_PT_SCOTCH)
    string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libptscotch-dev")
  endif()
endif()

include(CPack)
