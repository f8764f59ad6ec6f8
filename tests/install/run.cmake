# Installs a component of `build` into an empty prefix under `work`, builds the outside program of that name and runs it.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${work})
set(components cache)
set(arguments -G Ninja -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_PREFIX_PATH=${work}/prefix)
if(component STREQUAL "render")
  list(APPEND components render)
else()
  # The caching arm must be found where nothing of what the renderer needs is installed.
  foreach(package embree OpenEXR PNG TinyGLTF tomlplusplus fmt TBB OpenVDB)
    list(APPEND arguments -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
  endforeach()
endif()
foreach(part ${components})
  run(${CMAKE_COMMAND} --install ${build} --prefix ${work}/prefix --component ${part})
endforeach()

set(source ${CMAKE_CURRENT_LIST_DIR}/${component})
run(${CMAKE_COMMAND} --no-warn-unused-cli -S ${source} -B ${work}/build ${arguments})
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/program)

if(component STREQUAL "cache")
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/render -B ${work}/refused ${arguments}
                  RESULT_VARIABLE status ERROR_VARIABLE message OUTPUT_QUIET)
  if(status EQUAL 0 OR NOT message MATCHES "isophote::render is missing")
    message(FATAL_ERROR "isophote::render was not refused where it is not installed:\n${message}")
  endif()
endif()
