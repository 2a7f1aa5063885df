# Installs the engine: library, public headers and what find_package(carom) and pkg-config read.
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

# For pkg-config. The file finds the prefix from where it lies, so that the whole may be moved; folders given as absolute paths stay so.
# The standard library is not named: who uses carom is C++, and the linker of C++ brings it.
set(CAROM_PC_LIBDIR "\${prefix}")
cmake_path(APPEND CAROM_PC_LIBDIR "${CMAKE_INSTALL_LIBDIR}")
set(CAROM_PC_INCLUDEDIR "\${prefix}")
cmake_path(APPEND CAROM_PC_INCLUDEDIR "${CMAKE_INSTALL_INCLUDEDIR}")
cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_LIBDIR BASE_DIRECTORY "${CMAKE_INSTALL_PREFIX}" OUTPUT_VARIABLE CAROM_PC_DIR)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY "${CAROM_PC_DIR}/pkgconfig" OUTPUT_VARIABLE CAROM_PC_UP)
set(CAROM_PC_DEFINE "")
if(BUILD_SHARED_LIBS)
    set(CAROM_PC_DEFINE " -DCAROM_SHARED=1")
endif()
# Empty where threads are a part of the C library. A shared library brings them by itself.
find_package(Threads REQUIRED)
set(CAROM_PC_THREADS "")
if(CMAKE_THREAD_LIBS_INIT)
    set(CAROM_PC_THREADS " ${CMAKE_THREAD_LIBS_INIT}")
endif()
configure_file("${PROJECT_SOURCE_DIR}/cmake/carom.pc.in" "${PROJECT_BINARY_DIR}/carom.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/carom.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
