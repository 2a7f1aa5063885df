# Toolchain file of the presets that need clang: the pinned version, else the one Debian 12 always has.
find_program(CAROM_CLANG NAMES clang++-22 clang++-19 REQUIRED)
set(CMAKE_CXX_COMPILER "${CAROM_CLANG}")
