#pragma once

/// @file
/// Version and build configuration. Every configuration macro of the library stands in this file.

#define CAROM_VERSION_MAJOR 0
#define CAROM_VERSION_MINOR 1
#define CAROM_VERSION_PATCH 0
#define CAROM_VERSION_STRING "0.1.0"

/// The version as one number, 10,000 · major + 100 · minor + patch, for comparison in the preprocessor.
#define CAROM_VERSION (CAROM_VERSION_MAJOR * 10000 + CAROM_VERSION_MINOR * 100 + CAROM_VERSION_PATCH)

/// Marks the public API, all that a shared library exports. CMake defines CAROM_SHARED for the library and whoever links it where it is shared,
/// and CAROM_IS_BUILT while it is built.
#if defined(_WIN32) && defined(CAROM_SHARED) && defined(CAROM_IS_BUILT)
#define CAROM_API __declspec(dllexport)
#elif defined(_WIN32) && defined(CAROM_SHARED)
#define CAROM_API __declspec(dllimport)
#elif !defined(_WIN32) && defined(CAROM_SHARED)
#define CAROM_API __attribute__((visibility("default")))
#else
#define CAROM_API
#endif

/// 1 where refusals are thrown as carom::Error, 0 where they go to the handler set by carom::set_error_handler.
#if defined(__cpp_exceptions) || defined(__EXCEPTIONS) || defined(_CPPUNWIND)
#define CAROM_EXCEPTIONS 1
#else
#define CAROM_EXCEPTIONS 0
#endif
