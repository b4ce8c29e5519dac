# cmake -P prefix_glad.cmake FILES...: gives what glad has generated names of glint's own, so that a
# program that links glint may have a glad too.
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE 3 ${last})
  file(READ ${CMAKE_ARGV${i}} text)
  string(REGEX REPLACE "([^A-Za-z0-9_])glad_" "\\1glint_glad_" text "${text}")
  string(REGEX REPLACE "([^A-Za-z0-9_])gladLoad" "\\1glint_gladLoad" text "${text}")
  string(REGEX REPLACE "([^A-Za-z0-9_])GLAD_(E?GL_)" "\\1GLINT_GLAD_\\2" text "${text}")
  file(WRITE ${CMAKE_ARGV${i}} "${text}")
endforeach()
