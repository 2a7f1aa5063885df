# What every target of this project has in common.

include(CheckCXXCompilerFlag)
include(CheckCXXSourceCompiles)

# Two ways of spelling options. clang-cl takes MSVC's, and those of Clang by /clang:.
if(MSVC)
    set(CAROM_COMPILER_IS_GNU_LIKE FALSE)
else()
    set(CAROM_COMPILER_IS_GNU_LIKE TRUE)
endif()
# Asked of the compiler: CMAKE_SYSTEM_PROCESSOR may be the host's. Not where one build is for several processors.
check_cxx_source_compiles("
#if !defined(__x86_64__) && !defined(_M_X64)
#error
#endif
int main() { return 0; }" CAROM_FOR_X86)

# carom_known(<variable> <option>...): of these the options that the compiler knows.
function(carom_known variable)
    set(known "")
    foreach(option IN LISTS ARGN)
        string(MAKE_C_IDENTIFIER "CAROM_HAS${option}" answer)
        check_cxx_compiler_flag("${option}" ${answer})
        if(${answer})
            list(APPEND known "${option}")
        endif()
    endforeach()
    set(${variable} "${known}" PARENT_SCOPE)
endfunction()

# carom_options(<target> <option>...): those that the compiler knows.
function(carom_options target)
    carom_known(known ${ARGN})
    target_compile_options(${target} PRIVATE ${known})
endfunction()

# carom_target(<target>): language level, warnings, and the floating-point rule that determinism rests on.
function(carom_target target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
    # Compilers contract a*b+c to one rounding by default where the machine can: other bits than everywhere else. MSVC does not by /fp:precise.
    if(CAROM_COMPILER_IS_GNU_LIKE)
        carom_options(${target} -ffp-contract=off -fno-math-errno -Wall -Wextra -Wconversion -Wshadow)
    else()
        target_compile_options(${target} PRIVATE /fp:precise /W4 /utf-8 /wd4324 "$<$<CXX_COMPILER_ID:Clang>:/clang:-ffp-contract=off;/clang:-fno-math-errno>")
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL IntelLLVM)
        carom_options(${target} -fp-model=precise) # its default is fast
    endif()
    # g++ 12 takes a pair of doubles through floats without rounding them when it vectorizes the pair.
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        carom_options(${target} -fno-tree-slp-vectorize)
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CAROM_FOR_X86)
        # g++ clears and copies records of a few cache lines by instructions that take longer to begin than that takes.
        carom_options(${target} -mmemset-strategy=vector_loop:512:noalign,libcall:-1:noalign
                      -mmemcpy-strategy=vector_loop:512:noalign,libcall:-1:noalign)
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
        # g++ 12 sees an overlap in every inlined "text" + std::string (GCC bug 105651).
        target_compile_options(${target} PRIVATE -Wno-restrict)
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
        # clang reports what libstdc++ 12's own std::stable_sort calls; g++ reports what we call.
        carom_options(${target} -Wno-deprecated-declarations)
    endif()
    if(CAROM_WERROR)
        if(CAROM_COMPILER_IS_GNU_LIKE)
            carom_options(${target} -Werror)
        else()
            target_compile_options(${target} PRIVATE /WX)
        endif()
    endif()
    # A third of what a file takes to compile. g++ builds go without, but for tests: they tell where an include is missing.
    get_target_property(shared ${target} PRECOMPILE_HEADERS_REUSE_FROM)
    if(CMAKE_CXX_COMPILER_ID STREQUAL Clang AND NOT shared)
        target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdio> <functional> <map> <memory> <optional> <ostream>
                                  <span> <string> <vector>)
    endif()
endfunction()

# carom_fuzzed(<target>): fuzz targets see which ways their inputs take through it.
function(carom_fuzzed target)
    if(CAROM_BUILD_FUZZ)
        target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
    endif()
endfunction()

# carom_kernels(<folder>): the kernels in it are one source, compiled for what the machine may have; the choice falls at run time
# (src/dynamics/solver/simd/kernels.cpp). Sets CAROM_WITH_AVX where there are such for AVX2 and AVX-512. -Wno-psabi: vectors are passed to inlined functions
# only. -Wa,...: g++ for Windows aligns the stack to 16 bytes. -O1 in debug builds: nothing that the linker could take for another machine's is left
# out of line.
function(carom_kernels folder)
    # Precompiled headers belong to one set of instructions, and CAROM_ISA to one file.
    set_source_files_properties("${folder}/kernels_baseline.cpp" "${folder}/kernels_avx2.cpp" "${folder}/kernels_avx512.cpp"
                                PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
    set(CAROM_WITH_AVX FALSE PARENT_SCOPE)
    set(every "")
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        list(APPEND every -Wno-psabi)
        if(MINGW)
            list(APPEND every -Wa,-muse-unaligned-vector-move)
        endif()
    endif()
    set(avx2 -mavx2)
    set(avx512 -mavx512f -mavx512vl -mprefer-vector-width=256)
    set(wanted ${every} ${avx2} ${avx512})
    carom_known(known ${wanted})
    if(NOT CAROM_AVX OR NOT CAROM_FOR_X86 OR NOT known STREQUAL wanted)
        return()
    endif()
    list(APPEND every "$<$<CONFIG:Debug>:-O1>")
    set(CAROM_WITH_AVX TRUE PARENT_SCOPE)
    set_source_files_properties("${folder}/kernels_avx2.cpp" PROPERTIES COMPILE_OPTIONS "${every};${avx2}")
    set_source_files_properties("${folder}/kernels_avx512.cpp" PROPERTIES COMPILE_OPTIONS "${every};${avx512}")
endfunction()

# carom_command_line(<file>...): what reads a program's command line runs once; optimizing CLI11 takes half of compiling it.
function(carom_command_line)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -O0 SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# carom_glob(<variable> <pattern>...): the files of these patterns, relative to the current folder, found anew at each build.
function(carom_glob variable)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS LIST_DIRECTORIES false RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" ${ARGN})
    set(${variable} ${files} PARENT_SCOPE)
endfunction()

# carom_want(<variable> <what for> <package> [find_package arguments]): whether a package outside the engine is there;
# says so when it is not, and what is left out.
macro(carom_want variable purpose package)
    find_package(${package} ${ARGN} QUIET)
    if(${package}_FOUND)
        set(${variable} TRUE)
    else()
        set(${variable} FALSE)
        message(STATUS "carom: ${package} not found, left out: ${purpose} (scripts/setup installs what is missing)")
    endif()
endmacro()
