# Writes OUTPUT, which defines wheelwright::commit(): the commit of the sources in SOURCE, with "+" if they differ
# from it; empty where SOURCE is not the top of a git repository. Run at every build; the file is not written if
# nothing changed.
function(git result)
  execute_process(COMMAND git -C ${SOURCE} ${ARGN} OUTPUT_VARIABLE output ERROR_QUIET RESULT_VARIABLE failed
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    set(output "")
  endif()
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

set(commit "")
git(top rev-parse --show-toplevel)
file(REAL_PATH ${SOURCE} source)
if(top AND top STREQUAL source)
  git(commit rev-parse --short=12 HEAD)
  git(changes status --porcelain --untracked-files=no)
  if(commit AND changes)
    string(APPEND commit "+")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "wheelwright/case/version.h"

std::string_view wheelwright::commit() { return "@commit@"; }
]])
