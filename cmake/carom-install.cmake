# Installs the engine: library, public headers and what find_package(carom) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(CAROM_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/carom")

install(TARGETS carom EXPORT carom-targets
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}"
    INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/carom" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h")
install(EXPORT carom-targets NAMESPACE carom:: DESTINATION "${CAROM_CMAKE_DIR}")

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/carom-config.cmake.in" "${PROJECT_BINARY_DIR}/carom-config.cmake"
    INSTALL_DESTINATION "${CAROM_CMAKE_DIR}")
# Below 1.0 a new minor version may change the API.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/carom-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/carom-config.cmake" "${PROJECT_BINARY_DIR}/carom-config-version.cmake"
    DESTINATION "${CAROM_CMAKE_DIR}")
