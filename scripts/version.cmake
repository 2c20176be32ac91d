# Writes OUTPUT, a source with the program's version and git revision, but only if its content has changed.
execute_process(COMMAND git -c safe.directory=* -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 --match=
  OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT revision)
  set(revision "unknown")
endif()
set(content "#include <corotet/base/version.h>\n
namespace corotet
{
  const std::string version = \"${VERSION}\";
  const std::string git_revision = \"${revision}\";
} // namespace corotet
")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT "${old}" STREQUAL "${content}")
  file(WRITE ${OUTPUT} "${content}")
endif()
