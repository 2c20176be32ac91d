# `cmake --install`: the program with its scripts, ready cases and pages; the library with its public headers and what
# find_package(corotet) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The components of the installation. Each becomes a package.
set(runtime program)
set(development development)

install(TARGETS corotet RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${runtime})
set_target_properties(corotet PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
install(TARGETS corotet_gmsh RUNTIME DESTINATION libexec/corotet COMPONENT ${runtime})
install(TARGETS corotet_library EXPORT corotetTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${runtime} NAMELINK_COMPONENT ${development}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${development}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

# The scripts that the program starts (base/programs.h), scripts for results with their modules, and ready cases with their meshes.
# The cases name meshes by relative paths, so the folders keep their places.
set(data ${CMAKE_INSTALL_DATADIR}/corotet)
install(PROGRAMS scripts/draw_study scripts/plot scripts/render scripts/export scripts/report scripts/read_vtk DESTINATION ${data}/scripts COMPONENT ${runtime})
install(DIRECTORY scripts/report_page DESTINATION ${data}/scripts COMPONENT ${runtime} PATTERN __pycache__ EXCLUDE)
set(modules commands display exports fields films frames gltf lagrange results scene usd views)
list(TRANSFORM modules REPLACE "(.+)" "scripts/\\1.py")
install(FILES ${modules} DESTINATION ${data}/scripts COMPONENT ${runtime})
install(DIRECTORY parameters meshes DESTINATION ${data} COMPONENT ${runtime})
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT ${runtime})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT ${runtime})
install(DIRECTORY doc/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/doc COMPONENT ${runtime})
# Pages link to ready cases, meshes and the licence as in the sources.
cmake_path(RELATIVE_PATH data BASE_DIRECTORY ${CMAKE_INSTALL_DOCDIR} OUTPUT_VARIABLE data_from_pages)
install(CODE "foreach(folder parameters meshes)
  file(CREATE_LINK \"${data_from_pages}/\${folder}\" \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}/\${folder}\" SYMBOLIC)
endforeach()
file(CREATE_LINK copyright \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}/LICENSE\" SYMBOLIC)" COMPONENT ${runtime})
install(FILES doc/corotet.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${runtime})
install(FILES scripts/completion/corotet.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME corotet COMPONENT ${runtime})
install(FILES scripts/completion/_corotet DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT ${runtime})
install(FILES scripts/completion/corotet.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT ${runtime})
# The project of the tutorial, as an example.
install(DIRECTORY tests/external DESTINATION ${CMAKE_INSTALL_DOCDIR}/tests COMPONENT ${development})

install(CODE "set(SOURCE \"${PROJECT_SOURCE_DIR}/include\")
set(DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")" COMPONENT ${development})
install(SCRIPT ${CMAKE_CURRENT_LIST_DIR}/install_headers.cmake COMPONENT ${development})

set(package_files ${CMAKE_INSTALL_LIBDIR}/cmake/corotet)
install(EXPORT corotetTargets NAMESPACE corotet:: DESTINATION ${package_files} COMPONENT ${development})
get_target_property(COROTET_LIBRARY_TYPE corotet_library TYPE)
set(COROTET_DEAL_II_VERSION ${DEAL_II_VERSION_MAJOR}.${DEAL_II_VERSION_MINOR})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/corotetConfig.cmake.in ${PROJECT_BINARY_DIR}/corotetConfig.cmake
  INSTALL_DESTINATION ${package_files})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/corotetConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/corotetConfig.cmake ${PROJECT_BINARY_DIR}/corotetConfigVersion.cmake
  DESTINATION ${package_files} COMPONENT ${development})
