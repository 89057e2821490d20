# Installs the library with its headers, so that find_package(Talus) gives talus::talus.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Talus)

install(TARGETS talus EXPORT TalusTargets)
install(DIRECTORY talus DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT TalusTargets NAMESPACE talus:: DESTINATION ${package_dir})

configure_package_config_file(cmake/TalusConfig.cmake.in ${PROJECT_BINARY_DIR}/TalusConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/TalusConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/TalusConfig.cmake ${PROJECT_BINARY_DIR}/TalusConfigVersion.cmake
        DESTINATION ${package_dir})
