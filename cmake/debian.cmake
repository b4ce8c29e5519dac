# Installs the desktop integration, and sets up `cpack` to make the Debian packages glint,
# glint-viewer, libglint-dev and python3-glint. `.ci/packages` makes, installs and uses them.
set(packaging ${PROJECT_SOURCE_DIR}/packaging)
set(share ${CMAKE_INSTALL_DATADIR})

# With this, file managers show thumbnails of models.
install(FILES ${packaging}/glint.thumbnailer DESTINATION ${share}/thumbnailers COMPONENT viewer)
if(TARGET glint-viewer)
  install(FILES ${packaging}/glint-viewer.desktop DESTINATION ${share}/applications COMPONENT viewer)
  install(FILES ${packaging}/glint-viewer.svg DESTINATION ${share}/icons/hicolor/scalable/apps
          COMPONENT viewer)
  install(FILES ${packaging}/glint-viewer.metainfo.xml DESTINATION ${share}/metainfo COMPONENT viewer)
  install(FILES ${packaging}/glint-viewer.xml DESTINATION ${share}/mime/packages COMPONENT viewer)
endif()

# glint_package(COMPONENT NAME [DEPENDS packages...] [RECOMMENDS packages...] SUMMARY text TEXT lines
# PARTS packages...) makes the Debian package NAME from a component. Its licences are glint's and those
# of the PARTS packages, which are compiled into it; packages that it links at run time have their own.
set(CPACK_COMPONENTS_ALL "")
function(glint_package component name)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "SUMMARY;TEXT" "DEPENDS;RECOMMENDS;PARTS")
  file(READ ${PROJECT_SOURCE_DIR}/LICENSE copyright)
  foreach(part ${arg_PARTS})
    if(EXISTS /usr/share/doc/${part}/copyright)
      file(READ /usr/share/doc/${part}/copyright text)
      string(APPEND copyright "\n\nParts come from ${part}, whose licence is:\n\n${text}")
    endif()
  endforeach()
  file(WRITE ${PROJECT_BINARY_DIR}/packages/${name}/copyright "${copyright}")
  install(FILES ${PROJECT_BINARY_DIR}/packages/${name}/copyright ${PROJECT_SOURCE_DIR}/CHANGELOG.md
          DESTINATION ${share}/doc/${name} COMPONENT ${component})
  list(JOIN arg_DEPENDS ", " depends)
  list(JOIN arg_RECOMMENDS ", " recommends)
  string(TOUPPER ${component} upper)
  foreach(setting "PACKAGE_NAME;${name}" "PACKAGE_DEPENDS;${depends}" "PACKAGE_RECOMMENDS;${recommends}"
                  "DESCRIPTION;${arg_SUMMARY}\n${arg_TEXT}")
    list(POP_FRONT setting key)
    set(CPACK_DEBIAN_${upper}_${key} "${setting}" PARENT_SCOPE)
  endforeach()
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()

# The packages that are compiled in: header-only libraries, and generated code.
set(parts libglm-dev libcli11-dev nlohmann-json3-dev libstb-dev libtinygltf-dev python3-glad)
# The package version names the distribution, so that packages depend on others from the same one.
set(release "")
if(EXISTS /etc/os-release)
  file(STRINGS /etc/os-release release REGEX "^VERSION_ID=")
endif()
string(REGEX REPLACE "[^0-9.]" "" release "${release}")
set(CPACK_DEBIAN_PACKAGE_RELEASE "1~deb${release}")
set(version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")

# OpenGL is opened at run time: OSMesa suffices for drawing, EGL is needed to use a GPU.
glint_package(glint glint
  SUMMARY "draws and compares glTF models with the classic shading models"
  TEXT "Draws glTF 2.0 models without a GPU or a display, with flat, Gouraud, Phong\nand Blinn-Phong shading; compares pictures (FLIP, SSIM and others) and writes\nreports; measures speed and error of each way of shading."
  DEPENDS "libosmesa6 | libegl1"
  RECOMMENDS libegl1 libegl-mesa0 libgl1-mesa-dri
  PARTS ${parts})
if(TARGET glint-viewer)
  glint_package(viewer glint-viewer
    SUMMARY "window for editing the materials of glTF models"
    TEXT "The window of glint: materials, lights and camera in a panel, two looks side by\nside, plots of highlight and reflectance; model thumbnails in file managers."
    DEPENDS "glint (= ${version})" libgl1 libegl1 libgl1-mesa-dri fonts-dejavu-core
    RECOMMENDS shared-mime-info
    PARTS ${parts} libimgui-dev)
endif()
file(STRINGS ${PROJECT_SOURCE_DIR}/packages.txt needed REGEX "^lib.*-dev$")
list(REMOVE_ITEM needed libcli11-dev libstb-dev)
foreach(switch "MESHOPT;libmeshoptimizer-dev" "DRACO;libdraco-dev" "WEBP;libwebp-dev" "TIFF;libtiff-dev")
  list(POP_FRONT switch name)
  if(NOT GLINT_${name})
    list(REMOVE_ITEM needed ${switch})
  endif()
endforeach()
glint_package(dev libglint-dev
  SUMMARY "C++ libraries of glint"
  TEXT "Headers, static libraries, CMake and pkg-config files for drawing glTF models\nand comparing pictures from C++."
  DEPENDS "glint (= ${version})" ${needed} pkgconf
  PARTS ${parts})
if(TARGET glint_python)
  string(REGEX REPLACE "^3\\.([0-9]+)$" "\\1" minor ${GLINT_PYTHON_VERSION})
  math(EXPR minor "${minor} + 1")
  glint_package(python python3-glint
    SUMMARY "glint for Python"
    TEXT "Draws glTF models into NumPy arrays, with depth, normals and object ids;\ncompares pictures; has a fixture for pytest."
    DEPENDS "glint (= ${version})" "python3 (>= ${GLINT_PYTHON_VERSION})" "python3 (<< 3.${minor})" python3-numpy
    PARTS ${parts} pybind11-dev)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME glint)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_CONTACT "The glint authors <glint@localhost>")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
include(CPack)
