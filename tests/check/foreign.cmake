# Builds somebody else's golden tests and breaks their goldens on purpose, in a copy of their own:
#   cmake -DPROJECT=... -DFOLDER=... -DINSTALLED=PREFIX -DCOMPILER=... "-DFLAGS=..." -DFILTER=... -P foreign.cmake
# FILTER is an argument that selects one test, empty where there is none.
file(REMOVE_RECURSE ${FOLDER}/project ${FOLDER}/build ${FOLDER}/run)
file(COPY ${PROJECT}/ DESTINATION ${FOLDER}/project)
file(MAKE_DIRECTORY ${FOLDER}/run)
foreach(step "-S;${FOLDER}/project;-B;${FOLDER}/build;-G;Ninja;-DCMAKE_PREFIX_PATH=${INSTALLED};-DCMAKE_CXX_COMPILER=${COMPILER};-DCMAKE_CXX_FLAGS=${FLAGS}"
    "--build;${FOLDER}/build")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(failed)
    message(FATAL_ERROR "${said}")
  endif()
endforeach()

# Runs the tests; they must end with this code, and say each sentence that follows, in words of a regular expression.
function(expect code arguments)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env ${environment} ${FOLDER}/build/lens_tests ${arguments}
    WORKING_DIRECTORY ${FOLDER}/run RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  message("lens_tests ${arguments}: ${result}\n${said}")
  if(NOT result EQUAL code)
    message(FATAL_ERROR "exit code ${result}, not ${code}")
  endif()
  string(REGEX REPLACE "[ \n]+" "" said "${said}")  # Catch2 breaks lines
  foreach(sentence IN LISTS ARGN)
    string(REGEX REPLACE "[ \n]+" "" sentence "${sentence}")
    if(sentence MATCHES "^NOT(.*)")
      if(said MATCHES "${CMAKE_MATCH_1}")
        message(FATAL_ERROR "says '${CMAKE_MATCH_1}'")
      endif()
    elseif(NOT said MATCHES "${sentence}")
      message(FATAL_ERROR "does not say '${sentence}'")
    endif()
  endforeach()
endfunction()
function(expect_same a b)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${a} ${b} RESULT_VARIABLE differs)
  if(differs)
    message(FATAL_ERROR "${a} and ${b} are not the same")
  endif()
endfunction()
set(environment --unset=CI)
set(goldens ${FOLDER}/project/goldens)

expect(0 "" "NOT no test uses" "NOT updated")

# A golden that is another picture, one that is gone, one that is no picture.
file(GLOB_RECURSE orange ${goldens}/*range.png)
file(COPY_FILE ${orange} ${FOLDER}/run/right.png)
file(COPY_FILE ${CMAKE_CURRENT_LIST_DIR}/blue.png ${orange})
cmake_path(GET orange STEM LAST_ONLY name)
set(actual ${FOLDER}/run/golden_failures/${name}.actual.png)
expect(1 "" "${name}: 4096 pixels differ\n  golden      .*${name}.png\n  picture     .*${name}.actual.png\n  difference  .*${name}.difference.png"
  "\\(9, 0\\)  is 255 188   0 255  should be   0   0 255 255" "--update")
expect_same(${actual} ${FOLDER}/run/right.png)
file(WRITE ${orange} "no picture")
expect(1 "" "the golden cannot be read")
file(REMOVE ${orange})
expect(1 "" "there is no golden, so this picture is a candidate\n  golden      .*${name}.png\n  picture     .*${name}.actual.png")
expect_same(${actual} ${FOLDER}/run/right.png)

# --update: refused where CI is set, whatever it is set to; else it rewrites what failed, and fails.
foreach(value true 0 "")
  set(environment CI=${value})
  expect(2 --update "refused, because the environment has CI set")
endforeach()
if(EXISTS ${orange})
  message(FATAL_ERROR "${orange} was written")
endif()
set(environment --unset=CI)
expect(1 --update "updated: .*${name}.png" "look at them")
expect_same(${orange} ${FOLDER}/run/right.png)
expect(0 "" "NOT updated")

# A golden that no test uses, in a whole run only; an update leaves it alone.
file(COPY_FILE ${orange} ${goldens}/forgotten.png)
expect(1 "" "forgotten.png: no test uses this golden")
if(FILTER)
  expect(0 ${FILTER} "NOT no test uses")
endif()
expect(1 --update "no test uses this golden" "NOT updated")
file(REMOVE ${goldens}/forgotten.png)
expect(0 "")
