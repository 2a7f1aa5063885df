# Toolchain file for WebAssembly with 128-bit lanes, on WASI: clang and, of Debian, wasi-libc and libc++-<llvm>-dev-wasm32. `scripts/verify` builds
# carom-hash with it.
find_program(CAROM_CLANG NAMES clang++-22 clang++-19 REQUIRED)
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER "${CAROM_CLANG}")
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fno-exceptions -Wno-deprecated")
set(CMAKE_EXE_LINKER_FLAGS_INIT "--no-wasm-opt -Wl,-z,stack-size=1048576")
set(CMAKE_EXECUTABLE_SUFFIX_CXX .wasm)
# There are none, and nothing that is built so asks for them.
set(CMAKE_HAVE_PTHREAD_H TRUE CACHE INTERNAL "")
set(CMAKE_HAVE_LIBC_PTHREAD TRUE CACHE INTERNAL "")
