# deal.II is linked with all libraries that it has interfaces to: a start of the program would load more than 200 libraries and spend
# most of its time on them. So the program gets placeholders, empty libraries that take the place of those that it never calls (gmsh
# has a process of its own). It finds the placeholders first, by its RPATH, which holds for the libraries of its libraries, too. If a
# placeholder is missing, the real library is loaded. Only the program gets placeholders, and not what others link with the library.
# Switch this off if deal.II may be replaced without a new build of corotet, as by an update of the system.
if(NOT COROTET_PLACEHOLDERS)
  return()
endif()
# PETSc gets no placeholder: deal.II is compiled with PETSc's headers, which count each call of MPI in variables of PETSc.
set(left_out "lib(gmsh|TK|assimp|sundials|adolc|gsl|slepc|p4est|sc-|trilinos_nox)")
set(deal_ii_target dealii::dealii_$<IF:$<CONFIG:Debug>,debug,release>)
find_package(Python3 COMPONENTS Interpreter)
if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux" OR NOT Python3_FOUND OR NOT CMAKE_READELF OR NOT TARGET dealii::dealii_release)
  message(STATUS "Without placeholders of libraries that are never called: the program starts slower.")
  return()
endif()
set(placeholders ${PROJECT_BINARY_DIR}/lib/corotet/placeholders)
add_custom_command(OUTPUT ${placeholders}/made
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/placeholders.py $<TARGET_FILE:${deal_ii_target}> ${left_out} ${CMAKE_CXX_COMPILER} ${placeholders}
  COMMAND ${CMAKE_COMMAND} -E touch ${placeholders}/made
  DEPENDS ${CMAKE_CURRENT_LIST_DIR}/placeholders.py ${CMAKE_CURRENT_LIST_FILE} $<TARGET_FILE:${deal_ii_target}>
  COMMENT "Making placeholders of libraries that are never called" VERBATIM)
add_custom_target(corotet_placeholders DEPENDS ${placeholders}/made)
add_dependencies(corotet corotet_placeholders)
# The linker must write RPATH and not RUNPATH, which would hold for the program's own libraries only.
target_link_options(corotet PRIVATE LINKER:--disable-new-dtags)
set_property(TARGET corotet APPEND PROPERTY BUILD_RPATH ${placeholders})
set_property(TARGET corotet APPEND PROPERTY INSTALL_RPATH "$ORIGIN/../lib/corotet/placeholders")
install(DIRECTORY ${placeholders} DESTINATION lib/corotet COMPONENT program PATTERN made EXCLUDE)
