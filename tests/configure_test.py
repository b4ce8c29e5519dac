"""Configures the project as its users do: configure_test.py SOURCE SCRATCH"""

import pathlib
import shutil
import subprocess
import sys

source, scratch = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
shutil.rmtree(scratch, ignore_errors=True)


def configure(folder, *options):
    ran = subprocess.run(["cmake", "-S", folder, "-B", scratch / folder.name, "-G", "Ninja", *options],
                         text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return ran.returncode, ran.stdout


def check(holds, what):
    if not holds:
        sys.exit("not so: " + what)


# As part of a project whose targets have common names, it adds neither tests nor a window.
parent = scratch / "sources/parent"
parent.mkdir(parents=True)
(parent / "CMakeLists.txt").write_text("""cmake_minimum_required(VERSION 3.25)
project(parent LANGUAGES C CXX)
foreach(name models floor make_models tests plain_tests viewer image scene program)
  add_custom_target(${name})
endforeach()
add_subdirectory(%s glint)
add_library(plugin SHARED plugin.cpp)
target_link_libraries(plugin PRIVATE glint::glint)
if(TARGET glint-viewer OR TARGET glint_floor)
  message(FATAL_ERROR "more than the parent asked for")
endif()
""" % source)
(parent / "plugin.cpp").write_text("")
status, said = configure(parent)
check(status == 0, "a part of another project\n" + said)

# Missing dependencies are reported by their Debian package names, all at once.
status, said = configure(source, "-DCMAKE_DISABLE_FIND_PACKAGE_glm=ON",
                         "-DCMAKE_DISABLE_FIND_PACKAGE_draco=ON", "-DGLINT_TESTS=OFF")
check(status != 0 and "apt-get install --no-install-recommends libglm-dev libdraco-dev" in said and
      "GLINT_DRACO=OFF" in said, "missing packages are told\n" + said)
