# What `./relief package` gives cpack: builds of all widths in one package. The narrowest is installed last (it is what
# relief::engine means).
#   cpack --config engine/install/package.cmake -D SOURCE=... -D BUILD=... -D VERSION=... -D "PRESETS=package8;package4"
set(CPACK_PACKAGE_NAME relief)
set(CPACK_PACKAGE_VERSION ${VERSION})
set(CPACK_PACKAGE_VENDOR "The Relief authors")
set(CPACK_PACKAGE_CONTACT "The Relief authors <relief@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Software rasterizer with the same bits on every machine")
set(CPACK_PACKAGE_DESCRIPTION "Runs HLSL-like C++ programs on all cores, several pixels at a time, for pixel tests that
compare exactly. The program relief, and the library with its headers.")
set(CPACK_GENERATOR "DEB;TGZ")
set(CPACK_PACKAGE_DIRECTORY ${BUILD})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_CMAKE_PROJECTS "")
foreach(preset IN LISTS PRESETS)
  list(APPEND CPACK_INSTALL_CMAKE_PROJECTS ${BUILD}/${preset} relief ALL /)
endforeach()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libglm-dev, libexpected-dev")
set(CPACK_STRIP_FILES ON)
