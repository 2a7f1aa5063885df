# Builds the source tree that this port stands in. For a published source, put vcpkg_from_github(OUT_SOURCE_PATH SOURCE_PATH REPO ... REF ... SHA512 ...) here.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

# vcpkg.json must name the version itself.
file(STRINGS "${SOURCE_PATH}/include/carom/config.h" version_line REGEX "define CAROM_VERSION_STRING ")
if(NOT version_line MATCHES "\"${VERSION}\"")
    message(FATAL_ERROR "vcpkg.json says ${VERSION}, but include/carom/config.h: ${version_line}")
endif()

vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        -DCAROM_BUILD_TESTS=OFF
        -DCAROM_BUILD_PINBALL=OFF
        -DCAROM_BUILD_LAB=OFF
        -DCAROM_BUILD_BENCH=OFF
        -DCAROM_BUILD_EXAMPLES=OFF
        -DCAROM_INSTALL=ON
)

vcpkg_cmake_install()
vcpkg_copy_pdbs()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/carom)
vcpkg_fixup_pkgconfig()

# For users who build without CMake and pkg-config, and so without the define.
if(VCPKG_LIBRARY_LINKAGE STREQUAL "dynamic")
    vcpkg_replace_string("${CURRENT_PACKAGES_DIR}/include/carom/config.h" "defined(CAROM_SHARED)" "1")
endif()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include")

file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
