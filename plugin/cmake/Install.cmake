# SPDX-License-Identifier: MIT
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/osgEnvLight)
install(EXPORT osgEnvLightTargets NAMESPACE osgEnvLight:: DESTINATION ${package_dir})
configure_package_config_file(plugin/cmake/osgEnvLightConfig.cmake.in ${PROJECT_BINARY_DIR}/osgEnvLightConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/osgEnvLightConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/osgEnvLightConfig.cmake ${PROJECT_BINARY_DIR}/osgEnvLightConfigVersion.cmake
        DESTINATION ${package_dir})
