# glint_add_image_test(): a test that makes a picture and compares it with a baseline.
#
#   glint_add_image_test(
#     NAME name                      # name of the test and of its files
#     MODEL file | COMMAND words...  # a glTF model to draw, or a program that writes a picture;
#                                    # {output} in a word is replaced by the picture's path
#     BASELINE file                  # PNG, EXR, PFM; made by the test itself, see below
#     [LOOK file.json]               # for glint render --look, with MODEL
#     [RENDER_OPTIONS words...]      # further options of glint render, with MODEL
#     [METRIC names...]              # metrics of glint diff; without any, pictures must be equal
#     [THRESHOLD numbers...]         # one for each metric
#     [MAX_PIXELS n|p%]              # how many pixels may exceed the tolerance
#     [DIFF_OPTIONS words...]        # further options of glint diff: --ignore, --mask, --tolerance ...
#     [LABELS labels...])            # in addition to the label "image"
#
# Relative paths, including that of --mask, are relative to the current source folder. The test leaves
# its files in the folder GLINT_IMAGE_TEST_OUTPUT (image-tests in the current build folder):
# actual/FILE, baseline/FILE, difference/FILE.png, result/FILE.json, the program's output in
# log/FILE.txt, and the test's progress in status/FILE.txt. FILE is NAME with characters other than
# letters, digits, ".", "_" and "-" written as %XX, so that no two tests share a file. `glint diff --run
# FOLDER --html report.html` makes one page of all tests, including those that crashed or wrote nothing.
#
# Next to BASELINE there may be more baselines, for other machines: NAME_1.png, NAME_2.png ...; the
# nearest counts. The exit status is that of glint diff: 4 for a missing baseline, and the actual
# picture is then the candidate. With GLINT_UPDATE_BASELINES=1 in the environment the test instead
# makes the baseline, or replaces it if the comparison fails, and reports it.

set(_glint_image_test_script ${CMAKE_CURRENT_LIST_DIR}/glintImageTest.sh)

# Maps a test's name to a file name, one to one.
function(_glint_image_test_file name result)
  string(HEX "${name}" bytes)
  string(REGEX MATCHALL ".." bytes "${bytes}")
  set(file "")
  foreach(byte ${bytes})
    math(EXPR code "0x${byte}")
    string(ASCII ${code} letter)
    if(letter MATCHES "^[A-Za-z0-9_-]$" OR (byte STREQUAL "2e" AND file))
      string(APPEND file "${letter}")
    else()
      string(TOUPPER "${byte}" byte)
      string(APPEND file "%${byte}")
    endif()
  endforeach()
  set(${result} "${file}" PARENT_SCOPE)
endfunction()

function(glint_add_image_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;MODEL;BASELINE;LOOK;MAX_PIXELS"
                        "COMMAND;RENDER_OPTIONS;METRIC;THRESHOLD;DIFF_OPTIONS;LABELS")
  set(where "glint_add_image_test(NAME ${arg_NAME})")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${where}: unknown '${arg_UNPARSED_ARGUMENTS}'")
  endif()
  if(arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "${where}: nothing follows ${arg_KEYWORDS_MISSING_VALUES}")
  endif()
  if(NOT arg_NAME OR NOT arg_BASELINE)
    message(FATAL_ERROR "${where}: give NAME and BASELINE")
  endif()
  if((arg_MODEL AND arg_COMMAND) OR NOT (arg_MODEL OR arg_COMMAND))
    message(FATAL_ERROR "${where}: give MODEL or COMMAND")
  endif()
  if(arg_COMMAND AND (arg_LOOK OR arg_RENDER_OPTIONS))
    message(FATAL_ERROR "${where}: LOOK and RENDER_OPTIONS are for MODEL")
  endif()
  list(LENGTH arg_METRIC metrics)
  list(LENGTH arg_THRESHOLD thresholds)
  if(NOT metrics EQUAL thresholds)
    message(FATAL_ERROR "${where}: ${metrics} METRIC and ${thresholds} THRESHOLD: give one for each")
  endif()

  foreach(file BASELINE MODEL LOOK)
    if(arg_${file})
      get_filename_component(arg_${file} "${arg_${file}}" ABSOLUTE
                             BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
    endif()
  endforeach()
  set(folder "${GLINT_IMAGE_TEST_OUTPUT}")
  if(NOT folder)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/image-tests)
  endif()
  _glint_image_test_file("${arg_NAME}" file)
  get_filename_component(ending "${arg_BASELINE}" LAST_EXT)
  set(output "${folder}/actual/${file}${ending}")

  if(arg_MODEL)
    set(command "$<TARGET_FILE:glint::program>" render "${arg_MODEL}" -o "${output}")
    if(arg_LOOK)
      list(APPEND command --look "${arg_LOOK}")
    endif()
    list(APPEND command ${arg_RENDER_OPTIONS})
  else()
    set(command ${arg_COMMAND})
    string(FIND "${command}" "{output}" at)
    if(at EQUAL -1)
      message(FATAL_ERROR "${where}: no {output} in COMMAND: say where it takes the picture's path")
    endif()
    string(REPLACE "{output}" "${output}" command "${command}")
  endif()

  set(options "")
  set(before "")
  foreach(word ${arg_DIFF_OPTIONS})
    if(before STREQUAL "--mask")
      get_filename_component(word "${word}" ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
    endif()
    list(APPEND options "${word}")
    set(before "${word}")
  endforeach()
  foreach(metric threshold IN ZIP_LISTS arg_METRIC arg_THRESHOLD)
    list(APPEND options --metric ${metric} --threshold ${threshold})
  endforeach()
  if(arg_MAX_PIXELS)
    list(APPEND options --max-pixels ${arg_MAX_PIXELS})
  endif()

  # The files that `glint diff --run` reads: only for the tests of this configuration.
  get_property(begun GLOBAL PROPERTY "_glint_image_tests_of_${folder}")
  if(NOT begun)
    file(REMOVE_RECURSE "${folder}/tests")
    set_property(GLOBAL PROPERTY "_glint_image_tests_of_${folder}" TRUE)
  endif()
  list(JOIN options "\n" lines)
  file(GENERATE OUTPUT "${folder}/tests/${file}.txt"
       CONTENT "${arg_NAME}\n${arg_BASELINE}\n${ending}\n${lines}\n")

  list(LENGTH command words)
  add_test(NAME ${arg_NAME}
           COMMAND sh ${_glint_image_test_script} $<TARGET_FILE:glint::program> ${arg_BASELINE}
                   ${folder} ${file} ${ending} ${arg_NAME} ${words} ${command} ${options})
  set_tests_properties(${arg_NAME} PROPERTIES
    LABELS "image;${arg_LABELS}"
    ATTACHED_FILES_ON_FAIL "${output};${folder}/difference/${file}.png;${folder}/result/${file}.json")
endfunction()
