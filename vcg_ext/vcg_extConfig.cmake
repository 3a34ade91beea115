# SPDX-License-Identifier: GPL-3.0-or-later
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 NO_MODULE)
find_dependency(Threads)
find_dependency(PkgConfig)
if(NOT TARGET PkgConfig::sodium)
  pkg_check_modules(sodium REQUIRED QUIET IMPORTED_TARGET libsodium)
endif()
include("${CMAKE_CURRENT_LIST_DIR}/vcg_extTargets.cmake")
