# SPDX-License-Identifier: GPL-3.0-or-later
# Makes an imported target from a MeshLab source tree and the library of a built MeshLab.
#
#   meshlab_host(NAME SOURCE_DIR LIBRARY SCALAR)   ->   MeshLab::NAME
#
# LIBRARY is a libmeshlab-common, or empty: then the plugin finds MeshLab's symbols in the program that loads it (which
# serves MeshLab itself, but not pymeshlab). The target's properties: MESHLAB_PLUGIN_DIR (where that MeshLab looks for
# plugins; empty without a library).
#
# find_package(MeshLab) makes one target of each MeshLab that it finds and lists their names in MeshLab_HOSTS:
#   -DMESHLAB_SOURCE_DIR=DIR -DMESHLAB_LIBRARY=FILE -DMESHLAB_SCALAR=float|double   one of your own, or else
#   Debian's 2020.09 (float), pymeshlab's 2025.07 (double) and a downloaded 2025.07 in float, with the sources that
#   meshlab_scripts/setup.sh brought to build/sources.

set(MESHLAB_SOURCE_DIR "" CACHE PATH "A MeshLab source tree with src/common (and vcglib)")
set(MESHLAB_LIBRARY "" CACHE FILEPATH "The libmeshlab-common of the MeshLab to build for")
set(MESHLAB_SCALAR "float" CACHE STRING "The scalar that this MeshLab was built with: float or double")

find_package(Qt5 5.15 QUIET COMPONENTS Core Gui Widgets OpenGL Xml)
find_package(GLEW QUIET)
find_package(Eigen3 QUIET NO_MODULE)

function(meshlab_host name source_dir library scalar)
  file(READ "${source_dir}/ML_VERSION" version LIMIT 7)
  string(REGEX MATCH "^[0-9]+" year "${version}")
  set(vcglib "${source_dir}/src/vcglib")
  if(NOT EXISTS "${vcglib}/vcg")
    set(vcglib "${source_dir}/vcglib")
  endif()
  if(NOT EXISTS "${source_dir}/src/common" OR NOT EXISTS "${vcglib}/vcg")
    message(FATAL_ERROR "${source_dir} is no complete MeshLab source tree (src/common, vcglib). "
                        "Delete it and run meshlab_scripts/setup.sh sources, or clone MeshLab with its submodules.")
  endif()
  set(includes "${GLEW_INCLUDE_DIRS}" "${source_dir}/src" "${source_dir}/src/common" "${vcglib}")
  if(EXISTS "${vcglib}/eigenlib") # Debian's tree leaves it out
    list(APPEND includes "${vcglib}/eigenlib")
  endif()
  if(scalar STREQUAL "double")
    string(APPEND version "d")
  endif()

  if(library)
    add_library(MeshLab::${name} SHARED IMPORTED)
    set_target_properties(MeshLab::${name} PROPERTIES IMPORTED_LOCATION "${library}" IMPORTED_NO_SONAME FALSE)
    get_filename_component(library_dir "${library}" DIRECTORY)
    set_target_properties(MeshLab::${name} PROPERTIES MESHLAB_PLUGIN_DIR "${library_dir}/plugins")
  else()
    add_library(MeshLab::${name} INTERFACE IMPORTED)
  endif()
  set_target_properties(MeshLab::${name} PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${includes}"
    INTERFACE_COMPILE_DEFINITIONS "MESHLAB_YEAR=${year};MESHLAB_VERSION=${version};MESHLAB_SCALAR=${scalar}"
    INTERFACE_LINK_LIBRARIES "Eigen3::Eigen;Qt5::Core;Qt5::Gui;Qt5::Widgets;Qt5::OpenGL;Qt5::Xml")
  set(MeshLab_HOSTS ${MeshLab_HOSTS} ${name} PARENT_SCOPE)
endfunction()

set(MeshLab_HOSTS)
set(MeshLab_SOURCES "${PROJECT_SOURCE_DIR}/build/sources")
if(NOT Qt5_FOUND OR NOT GLEW_FOUND OR NOT Eigen3_FOUND)
  message(STATUS "A plugin needs Qt 5.15 (Core, Gui, Widgets, OpenGL, Xml), GLEW and Eigen, and one of these is missing.")
elseif(MESHLAB_SOURCE_DIR)
  file(READ "${MESHLAB_SOURCE_DIR}/ML_VERSION" MeshLab_VERSION LIMIT 7)
  meshlab_host("${MeshLab_VERSION}" "${MESHLAB_SOURCE_DIR}" "${MESHLAB_LIBRARY}" "${MESHLAB_SCALAR}")
else()
  find_library(MESHLAB_2020_LIBRARY meshlab-common PATH_SUFFIXES meshlab)
  file(GLOB MeshLab_PYMESHLAB "${PROJECT_SOURCE_DIR}/build/venv/lib/python3*/site-packages/pymeshlab/lib/libmeshlab-common.so")
  if(MESHLAB_2020_LIBRARY AND EXISTS "${MeshLab_SOURCES}/meshlab-2020.09")
    meshlab_host(2020.09 "${MeshLab_SOURCES}/meshlab-2020.09" "${MESHLAB_2020_LIBRARY}" float)
  endif()
  if(EXISTS "${MeshLab_SOURCES}/meshlab-2025.07")
    if(MeshLab_PYMESHLAB)
      meshlab_host(2025.07 "${MeshLab_SOURCES}/meshlab-2025.07" "${MeshLab_PYMESHLAB}" double)
    endif()
    meshlab_host(2025.07-float "${MeshLab_SOURCES}/meshlab-2025.07" "" float)
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MeshLab REQUIRED_VARS MeshLab_HOSTS Qt5_FOUND GLEW_FOUND)
