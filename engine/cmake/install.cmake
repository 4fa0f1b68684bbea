# What is installed, and the Debian packages. Component runtime: shared libraries and programs; development: the rest.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/cullet)
set(package_files ${CMAKE_CURRENT_LIST_DIR})
set(generated ${CMAKE_CURRENT_BINARY_DIR}/package)

# Two sets, so that who asks for the core alone needs no Bullet.
function(install_library library export)
  install(TARGETS ${library} EXPORT ${export}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT ${export} NAMESPACE cullet:: DESTINATION ${package_folder})
endfunction()
install_library(cullet_core culletCoreTargets)
install_library(cullet culletTargets)
install(DIRECTORY engine/include/cullet DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
foreach(program sample_game cullet_import)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
  endif()
endforeach()
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(${package_files}/culletConfig.cmake.in ${generated}/culletConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${generated}/culletConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${generated}/culletConfig.cmake ${generated}/culletConfigVersion.cmake DESTINATION ${package_folder})
if(NOT BUILD_SHARED_LIBS)
  install(FILES ${package_files}/FindCulletBullet.cmake DESTINATION ${package_folder})
endif()

# pkg-config: the folders are found from the file's own, so that a prefix can be moved.
set(pc_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pc_prefix /prefix/${pc_folder} /prefix)
string(REGEX REPLACE "/$" "" pc_prefix ${pc_prefix})
set(core_requires "tbb, libhwy, libxxhash, libzstd")
set(core_libraries "-lembree3 -pthread")  # Embree has no file of its own
function(write_pc name description libraries requires private_requires private_libraries)
  configure_file(${package_files}/cullet.pc.in ${generated}/${name}.pc @ONLY)
  install(FILES ${generated}/${name}.pc DESTINATION ${pc_folder})
endfunction()
write_pc(cullet-core "Meshes crack and shatter in real time, in a host with its own physics" -lcullet_core ""
         "${core_requires}" "${core_libraries}")
if(BUILD_SHARED_LIBS)
  write_pc(cullet "Meshes crack and shatter in real time, beside Bullet" -lcullet "" "${core_requires}, bullet"
           "${core_libraries}")
else()
  write_pc(cullet "Meshes crack and shatter in real time, beside Bullet" -lcullet
           "cullet-core = ${PROJECT_VERSION}" bullet "")
endif()

# cullet: libraries and programs. cullet-dev: what a game is built with.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME cullet)
set(CPACK_PACKAGE_VENDOR "The cullet authors")
set(CPACK_PACKAGE_CONTACT "The cullet authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Meshes crack and shatter in real time")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME cullet)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME cullet-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Libraries, the sample game and the mesh importer.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers, and files for CMake and pkg-config.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "cullet (= ${PROJECT_VERSION})")
if(NOT BUILD_SHARED_LIBS)  # an archive is linked with what it needs
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
         ", libbullet-dev, libembree-dev, libtbb-dev, libhwy-dev, libxxhash-dev, libzstd-dev, pkg-config")
endif()
include(CPack)
