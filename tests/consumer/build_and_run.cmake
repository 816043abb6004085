# Builds a program against the library with these flags, and runs it in its folder with ARGUMENTS, if there are any, and
# then once more with MORE. What the linker or the program says is printed.
#   cmake -DSOURCE=... -DFOLDER=... -DCOMPILER=... "-DFLAGS=..." "-DLIBRARIES=..." [-DARGUMENTS=...] [-DMORE=...]
#     -P build_and_run.cmake
file(MAKE_DIRECTORY ${FOLDER})
separate_arguments(flags UNIX_COMMAND "${FLAGS}")
separate_arguments(libraries UNIX_COMMAND "${LIBRARIES}")
execute_process(COMMAND ${COMPILER} ${flags} ${SOURCE} -o ${FOLDER}/program ${libraries}
  RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(failed)
  message(FATAL_ERROR "${said}")
endif()
set(runs ARGUMENTS)
if(DEFINED MORE)
  set(runs ARGUMENTS MORE)
endif()
foreach(run IN LISTS runs)
  separate_arguments(arguments UNIX_COMMAND "${${run}}")
  execute_process(COMMAND ./program ${arguments} WORKING_DIRECTORY ${FOLDER}
    RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(failed)
    message(FATAL_ERROR "${said}")
  endif()
  message("${said}")
endforeach()
