# Finds OpenVDB with NanoVDB's headers and gives the target OpenVDB::openvdb. OpenVDB's own module also demands the
# development files of what its library links (Boost.Iostreams, log4cplus, Blosc, zlib): those who use it do not need them.
# Boost is here for headers that OpenVDB's include.
include(FindPackageHandleStandardArgs)
find_path(OpenVDB_INCLUDE_DIR openvdb/openvdb.h)
find_path(OpenVDB_NANOVDB_INCLUDE_DIR nanovdb/util/OpenToNanoVDB.h)
find_path(OpenVDB_BOOST_INCLUDE_DIR boost/uuid/uuid.hpp)
find_library(OpenVDB_LIBRARY openvdb)
find_package(TBB QUIET CONFIG)
find_package(Imath QUIET CONFIG)
if(OpenVDB_INCLUDE_DIR)
  file(STRINGS ${OpenVDB_INCLUDE_DIR}/openvdb/version.h OpenVDB_version_lines REGEX "define OPENVDB_LIBRARY_M[A-Z]+_VERSION_NUMBER [0-9]+")
  string(REGEX MATCHALL "[0-9]+" OpenVDB_VERSION "${OpenVDB_version_lines}")
  list(JOIN OpenVDB_VERSION . OpenVDB_VERSION)
endif()
find_package_handle_standard_args(OpenVDB VERSION_VAR OpenVDB_VERSION REQUIRED_VARS
  OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR OpenVDB_NANOVDB_INCLUDE_DIR OpenVDB_BOOST_INCLUDE_DIR TBB_FOUND Imath_FOUND)
mark_as_advanced(OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR OpenVDB_NANOVDB_INCLUDE_DIR OpenVDB_BOOST_INCLUDE_DIR)

if(OpenVDB_FOUND AND NOT TARGET OpenVDB::openvdb)
  add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
  set_target_properties(OpenVDB::openvdb PROPERTIES IMPORTED_LOCATION ${OpenVDB_LIBRARY})
  target_include_directories(OpenVDB::openvdb INTERFACE
    ${OpenVDB_INCLUDE_DIR} ${OpenVDB_NANOVDB_INCLUDE_DIR} ${OpenVDB_BOOST_INCLUDE_DIR})
  target_link_libraries(OpenVDB::openvdb INTERFACE TBB::tbb Imath::Imath)
endif()
