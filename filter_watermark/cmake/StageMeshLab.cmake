# SPDX-License-Identifier: GPL-3.0-or-later
# stage_meshlab(PLUGIN_FILE LIBRARY): build/stage, a copy of the installed MeshLab 2020.09 with the plugin in it, so that trying the
# plugin needs no root. MeshLab finds plugins and libraries from where its binary lies, so binaries are copied, the rest
# are links.
function(stage_meshlab plugin_file library)
  find_program(MESHLAB_PROGRAM meshlab)
  find_program(MESHLABSERVER_PROGRAM meshlabserver)
  if(NOT MESHLAB_PROGRAM OR NOT MESHLABSERVER_PROGRAM)
    return()
  endif()
  get_filename_component(library_dir "${library}" DIRECTORY)
  set(stage "${PROJECT_BINARY_DIR}/stage")
  set(lib "${stage}/lib/${CMAKE_LIBRARY_ARCHITECTURE}/meshlab")
  file(REMOVE_RECURSE "${stage}")
  file(MAKE_DIRECTORY "${lib}/plugins")
  file(COPY "${MESHLAB_PROGRAM}" "${MESHLABSERVER_PROGRAM}" DESTINATION "${stage}/bin")
  file(CREATE_LINK "${library}" "${lib}/libmeshlab-common.so" SYMBOLIC)
  file(GLOB plugins "${library_dir}/plugins/*.so")
  foreach(plugin IN LISTS plugins ITEMS "${plugin_file}")
    get_filename_component(name "${plugin}" NAME)
    file(CREATE_LINK "${plugin}" "${lib}/plugins/${name}" SYMBOLIC)
  endforeach()
endfunction()
