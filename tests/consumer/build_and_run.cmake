# Builds a program against the library with these flags, and runs it. What the linker or the program says is printed.
#   cmake -DSOURCE=... -DFOLDER=... -DCOMPILER=... "-DFLAGS=..." "-DLIBRARIES=..." -P build_and_run.cmake
file(MAKE_DIRECTORY ${FOLDER})
separate_arguments(flags UNIX_COMMAND "${FLAGS}")
separate_arguments(libraries UNIX_COMMAND "${LIBRARIES}")
execute_process(COMMAND ${COMPILER} ${flags} ${SOURCE} -o ${FOLDER}/program ${libraries}
  RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT failed)
  execute_process(COMMAND ${FOLDER}/program OUTPUT_VARIABLE said ERROR_VARIABLE said)
endif()
message("${said}")
