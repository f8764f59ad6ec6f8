# What `cmake --install` gives: the program, the headers, the static libraries and find_package(isophote), in the
# components `cache` (the caching arm) and `render` (everything else). Included where the folders and targets are named.
include(CMakePackageConfigHelpers)
set(isophote_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/isophote)

function(isophote_install component)
  install(TARGETS isophote_${component} EXPORT isophote-${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component})
  install(EXPORT isophote-${component} NAMESPACE isophote:: DESTINATION ${isophote_package_dir} COMPONENT ${component})
  foreach(folder ${ARGN})
    install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/isophote COMPONENT ${component}
            FILES_MATCHING PATTERN "*.h"
            REGEX "/((gltf|toml)_[^/]*|media_toml|nano_voxels|density_grid_impl)\\.h$" EXCLUDE)  # the parts of readers are their own affair
  endforeach()
endfunction()

isophote_install(cache ${cache_folders})
if(ISOPHOTE_RENDER)
  isophote_install(render ${render_folders})
  if(TARGET isophote)
    install(TARGETS isophote RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT render)
  endif()
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/isophote-config.cmake.in ${PROJECT_BINARY_DIR}/isophote-config.cmake
                              INSTALL_DESTINATION ${isophote_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/isophote-config-version.cmake COMPATIBILITY SameMinorVersion)
if(OpenVDB IN_LIST render_packages)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/FindOpenVDB.cmake DESTINATION ${isophote_package_dir} COMPONENT render)
endif()
install(FILES ${PROJECT_BINARY_DIR}/isophote-config.cmake ${PROJECT_BINARY_DIR}/isophote-config-version.cmake
        DESTINATION ${isophote_package_dir} COMPONENT cache)
