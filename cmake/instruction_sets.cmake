# Builds the whole library once more for each of COROTET_INSTRUCTION_SETS, in folders that the dynamic loader searches first if the
# processor has these instructions (glibc 2.33 or newer; `man ld.so`, glibc-hwcaps). So the loader chooses at run time. All code of a
# library is for one instruction set, and no function compiled for another set can take the place of its own. All these libraries fit
# the same programs, because nothing in the public headers depends on the length of registers.
function(corotet_add_instruction_set set)
  set(target corotet_library_${set})
  get_target_property(all_sources corotet_library SOURCES)
  add_library(${target} SHARED ${all_sources})
  foreach(property COMPILE_DEFINITIONS COMPILE_OPTIONS COMPILE_FEATURES INCLUDE_DIRECTORIES LINK_LIBRARIES LINK_OPTIONS OUTPUT_NAME VERSION SOVERSION PRECOMPILE_HEADERS)
    get_target_property(value corotet_library ${property})
    if(value)
      set_property(TARGET ${target} PROPERTY ${property} ${value})
    endif()
  endforeach()
  target_include_directories(${target} SYSTEM PRIVATE ${GMSH_INCLUDE_DIR} ${CHOLMOD_INCLUDE_DIR} ${MUPARSER_INCLUDE_DIR} ${GINAC_INCLUDE_DIR})
  target_compile_options(${target} PRIVATE -march=${set})
  set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/glibc-hwcaps/${set})
  add_dependencies(${target} corotet_version)
  corotet_compile_together(${target} 24)
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/glibc-hwcaps/${set} COMPONENT program NAMELINK_SKIP)
endfunction()

if(COROTET_INSTRUCTION_SETS)
  if(NOT BUILD_SHARED_LIBS OR NOT COROTET_PORTABLE)
    message(FATAL_ERROR "COROTET_INSTRUCTION_SETS needs BUILD_SHARED_LIBS, as the dynamic loader chooses, and COROTET_PORTABLE, "
                        "for processors that have none of them.")
  endif()
  foreach(set IN LISTS COROTET_INSTRUCTION_SETS)
    corotet_add_instruction_set(${set})
  endforeach()
endif()
