# cmake -P prefix_glad.cmake FILES...: prefixes the names that glad has generated, so that a program
# that links glint can use a glad of its own.
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE 3 ${last})
  file(READ ${CMAKE_ARGV${i}} text)
  string(REGEX REPLACE "([^A-Za-z0-9_])glad_" "\\1glint_glad_" text "${text}")
  string(REGEX REPLACE "([^A-Za-z0-9_])gladLoad" "\\1glint_gladLoad" text "${text}")
  string(REGEX REPLACE "([^A-Za-z0-9_])GLAD_(E?GL_)" "\\1GLINT_GLAD_\\2" text "${text}")
  file(WRITE ${CMAKE_ARGV${i}} "${text}")
endforeach()
